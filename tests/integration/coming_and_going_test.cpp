// Sensors leave and come back in every way there is, and the daemon says what it saw.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "bus/raw_writer.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

class ComingAndGoing : public Rig {
 protected:
  /// States as in docs/metrics.md.
  static constexpr double kActive = 0.0;
  static constexpr double kDeadlineMissed = 2.0;
  static constexpr double kLivelinessLost = 3.0;
  static constexpr double kEnded = 4.0;

  [[nodiscard]] bus::BusOptions options() const {
    bus::BusOptions options;
    options.domain_id = domain_id();
    return options;
  }
  [[nodiscard]] bus::Domain domain() const { return {domain_id(), "loopback"}; }

  static double value(const Process& daemon, const std::string& series) {
    return metric(daemon, series).value_or(-1.0);
  }
  static double state(const Process& daemon) { return value(daemon, "gyrod_sensor_state{sensor=\"imu1\"}"); }
  static bool reaches(const Process& daemon, double wanted) {
    return eventually([&] { return state(daemon) == wanted; });
  }

  static void send(bus::RawWriter& writer, std::span<const stream::Sample> samples) {
    ASSERT_TRUE(writer.wait_for_subscriber(std::chrono::seconds(60)));
    ASSERT_EQ(writer.publish("imu1", samples), samples.size());
  }

  /// All that was taken has left, and nothing was refused.
  static void expect_all_published(const Process& daemon, double samples) {
    EXPECT_TRUE(eventually([&] { return value(daemon, "gyrod_samples_published_total") == samples; }));
    EXPECT_EQ(value(daemon, "gyrod_samples_received_total"), samples);
    EXPECT_EQ(value(daemon, "gyrod_samples_in_flight"), 0.0);
  }

  /// After a reboot: numbers from 0, and a clock that begins in 1970.
  static std::vector<stream::Sample> rebooted(std::uint64_t samples) {
    std::vector<stream::Sample> all = noisy_samples(samples);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].sequence = i;
      all[i].stamp_ns = static_cast<std::int64_t>(i) * 10'000'000;
    }
    return all;
  }
  /// Before it: far up, and today.
  static std::vector<stream::Sample> running(std::uint64_t samples, std::uint64_t first = 100'000) {
    std::vector<stream::Sample> all = noisy_samples(samples);
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].sequence = first + i;
      all[i].stamp_ns = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(all[i].sequence) * 10'000'000;
    }
    return all;
  }
};

TEST_F(ComingAndGoing, AMissedDeadlineReleasesTheTailAtOnceAndARebootBeginsAnew) {
  const auto daemon = start_daemon({.patch = R"({"bus": {"input": {"deadline_s": 0.5}}})"});
  bus::BusOptions promising = options();
  promising.input.deadline_s = 0.5;
  bus::RawWriter writer(domain(), promising);
  send(writer, running(200));
  ASSERT_TRUE(reaches(*daemon, kDeadlineMissed));
  expect_all_published(*daemon, 200.0);
  EXPECT_GE(value(*daemon, "gyrod_bus_deadlines_missed_total"), 1.0);
  EXPECT_EQ(value(*daemon, "gyrod_sensors_silent"), 1.0);
  send(writer, rebooted(200));
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_samples_received_total") == 400.0; }));
  ASSERT_TRUE(reaches(*daemon, kDeadlineMissed)) << "and it pauses again";
  expect_all_published(*daemon, 400.0);
  EXPECT_EQ(value(*daemon, "gyrod_restarts_total"), 1.0);
  EXPECT_EQ(value(*daemon, "gyrod_samples_missing_total"), 0.0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(ComingAndGoing, AWriterThatGivesNoSignOfLifeIsLostUntilItWritesAgain) {
  const auto daemon = start_daemon(
      {.patch = R"({"bus": {"input": {"liveliness": "manual_by_topic", "liveliness_lease_s": 0.5}}})"});
  bus::BusOptions promising = options();
  promising.input.liveliness = bus::Liveliness::kManualByTopic;
  promising.input.lease_s = 0.5;
  bus::RawWriter writer(domain(), promising);
  send(writer, running(200));
  ASSERT_TRUE(reaches(*daemon, kLivelinessLost));
  expect_all_published(*daemon, 200.0);
  EXPECT_EQ(value(*daemon, "gyrod_bus_liveliness_lost_total"), 1.0);
  send(writer, running(200, 100'200));
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_bus_liveliness_lost_total") == 2.0; }));
  expect_all_published(*daemon, 400.0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(ComingAndGoing, ASensorThatUnregistersEndsAndAnotherOfItsNameBeginsAnywhere) {
  const auto daemon = start_daemon();
  {
    bus::RawWriter writer(domain(), options());
    send(writer, running(200));
    ASSERT_TRUE(writer.end("imu1"));
    ASSERT_TRUE(reaches(*daemon, kEnded));
    expect_all_published(*daemon, 200.0);
  }
  bus::RawWriter again(domain(), options());
  send(again, rebooted(200));
  ASSERT_TRUE(again.end("imu1"));
  expect_all_published(*daemon, 400.0);
  EXPECT_EQ(value(*daemon, "gyrod_restarts_total"), 0.0) << "its end was known";
  EXPECT_EQ(value(*daemon, "gyrod_sensors"), 1.0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(ComingAndGoing, AProcessThatIsKilledEndsItsSensorAfterItsLeaseAndTheNextOneIsTaken) {
  const auto daemon = start_daemon();
  std::string xml =
      read_text(std::string(std::getenv("GYROD_SOURCE_DIR")) + "/config/cyclonedds/loopback.xml");
  const std::string place = "<Discovery>";
  xml.insert(xml.find(place) + place.size(), "<LeaseDuration>1s</LeaseDuration>");
  write_file("short_lease.xml", xml);
  write_config({.patch = R"({"bus": {"network": "short_lease.xml"}})"}, "sensor.json");
  const std::vector<std::string> simulate = {"simulate", "--sensor", "imu1", "--config", path("sensor.json")};
  const auto killed = start(simulate);
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_samples_published_total") > 100.0; }));
  killed->signal(SIGKILL);
  killed->wait();
  ASSERT_TRUE(reaches(*daemon, kEnded));
  EXPECT_EQ(value(*daemon, "gyrod_samples_in_flight"), 0.0) << "what was held is released";
  EXPECT_EQ(value(*daemon, "gyrod_bus_matched_writers"), 0.0);
  const double before = value(*daemon, "gyrod_samples_published_total");
  const auto next = start(simulate);  // from number 0 on
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_samples_published_total") > before + 100.0; }));
  EXPECT_EQ(state(*daemon), kActive);
  next->signal(SIGINT);
  next->wait();
  ASSERT_TRUE(reaches(*daemon, kEnded));
  EXPECT_EQ(value(*daemon, "gyrod_samples_received_total"), value(*daemon, "gyrod_samples_published_total"))
      << "nothing was refused";
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(ComingAndGoing, OneThatStaysAwayIsForgottenWithItsMetrics) {
  const auto daemon = start_daemon(
      {.silent_after_s = 0.2, .forget_after_s = 1.0, .patch = R"({"bus": {"input": {"deadline_s": 0.2}}})"});
  bus::BusOptions promising = options();
  promising.input.deadline_s = 0.2;
  bus::RawWriter writer(domain(), promising);
  send(writer, running(200));
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_sensors_forgotten_total") == 1.0; }));
  EXPECT_EQ(value(*daemon, "gyrod_sensors"), 0.0);
  EXPECT_EQ(state(*daemon), -1.0) << "its series are gone";
  send(writer, rebooted(10));
  ASSERT_TRUE(eventually([&] { return value(*daemon, "gyrod_samples_received_total") == 210.0; }));
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(ComingAndGoing, APeerThatDoesNotMatchIsNamedInTheLogAndCounted) {
  const auto daemon = start_daemon({.patch = R"({"bus": {"input": {"deadline_s": 0.5}}})"});
  {
    bus::RawWriter writer(domain(), options());  // promises nothing
    ASSERT_TRUE(daemon->wait_for_err("set bus.input.deadline_s"));
    EXPECT_EQ(value(*daemon, "gyrod_bus_incompatible_peers{direction=\"input\",policy=\"deadline\"}"), 1.0);
  }
  EXPECT_TRUE(eventually([&] {
    return value(*daemon, "gyrod_bus_incompatible_peers{direction=\"input\",policy=\"deadline\"}") == 0.0;
  }));
  const std::string log = daemon->err();
  EXPECT_NE(log.find("it offers deadline none, gyrod asks for 0.5 s"), std::string::npos) << log;
  EXPECT_NE(log.find("'coming_and_going_test' (process "), std::string::npos) << log;
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
