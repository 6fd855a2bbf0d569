// What vehicles do to processes and networks while the daemon runs: it recovers without a restart, and loses nothing but what it names.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <gyrod.h>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <dds/dds.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/raw_writer.hpp"
#include "foreign_writer.hpp"
#include "rig.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"
#include "support/samples.hpp"
#include "support/slow_build.hpp"

namespace gyrod::testing {
namespace {

using ::testing::HasSubstr;

class Faults : public Rig {
 protected:
  [[nodiscard]] const bus::Domain& domain() const { return domain_; }
  [[nodiscard]] Arrivals arrivals(const std::string& sensor) const {
    return {domain_, bus::BusOptions{}, "gyro/denoised", sensor};
  }
  std::unique_ptr<Process> start_sensor(const std::string& sensor, const std::string& rate,
                                        const std::string& batch = "1") {
    return start_on_bus({"simulate", "--sensor", sensor, "--rate", rate, "--batch", batch, "--wait", "60"});
  }
  static double rejected(const Process& daemon, const std::string& reason) {
    return of(daemon, "gyrod_samples_rejected_total{reason=\"" + reason + "\"}");
  }
  static void send(bus::RawWriter& writer, const std::string& sensor,
                   std::span<const stream::Sample> samples) {
    while (!samples.empty()) samples = samples.subspan(writer.publish(sensor, samples));
  }
  /// A sensor of this process that has been found by the daemon.
  [[nodiscard]] bus::RawWriter writer(const Process& daemon) const {
    bus::RawWriter made(domain_, bus::BusOptions{});
    EXPECT_TRUE(made.wait_for_subscriber(std::chrono::seconds{60}));
    EXPECT_TRUE(eventually([&] { return of(daemon, "gyrod_bus_matched_writers") >= 1.0; }));
    return made;
  }
  static void expect_balanced(const Process& daemon) {
    EXPECT_TRUE(eventually([&] { return is_balanced(daemon); }));
  }

 private:
  bus::Domain domain_{domain_id(), "loopback"};
};

// Longer than limits.silent_after_s: who was stopped must not take its sensors for silent.
TEST_F(Faults, ADaemonThatIsStoppedForAWhileGoesOnAndLosesNothing) {
  const auto daemon = start_daemon({.silent_after_s = 1.0});
  const Arrivals output = arrivals("imu");
  const auto sensor = start_sensor("imu", "100");
  ASSERT_TRUE(output.more_arrive(100));
  daemon->signal(SIGSTOP);
  const auto stopped = std::chrono::steady_clock::now();
  ASSERT_TRUE(
      eventually([&] { return std::chrono::steady_clock::now() - stopped > std::chrono::seconds{5}; }));
  daemon->signal(SIGCONT);
  ASSERT_TRUE(output.more_arrive(700));
  EXPECT_EQ(output.missing(), 0U);
  EXPECT_EQ(output.duplicates(), 0U);
  EXPECT_EQ(of(*daemon, "gyrod_silences_total"), 0.0);
  EXPECT_EQ(of(*daemon, "gyrod_gaps_total"), 0.0);
  EXPECT_EQ(of(*daemon, "gyrod_samples_missing_total"), 0.0);
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Faults, ASubscriberThatHangsHoldsNobodyUp) {
  const auto daemon = start_daemon();
  const Arrivals output = arrivals("imu");
  const auto stuck = start_recorder("stuck.csv", {"--until-end"});
  constexpr std::size_t kSome = kSlowBuild ? 300 : 1000;
  const auto sensor = start_sensor("imu", kSlowBuild ? "600" : "2000", "20");
  ASSERT_TRUE(output.more_arrive(kSome));
  stuck->signal(SIGSTOP);
  ASSERT_TRUE(output.more_arrive(5 * kSome));
  EXPECT_EQ(output.missing(), 0U);
  EXPECT_LT(of(*daemon, "gyrod_samples_in_flight"), 2000.0);
  stuck->signal(SIGCONT);
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0);
  ASSERT_TRUE(eventually([&] { return of(*daemon, "gyrod_samples_in_flight") == 0.0; }));
  // It gets what the daemon keeps for late readers; what it has lost, it names: exit code 6.
  const int end = stuck->wait();
  EXPECT_TRUE(end == 0 || (end == 6 && stuck->err().find("missing") != std::string::npos)) << stuck->err();
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Faults, ASensorThatSendsAHundredTimesItsRateCostsTheOthersNothing) {
  constexpr double kFlood = kSlowBuild ? 5'000.0 : 20'000.0;
  const auto daemon = start_daemon();
  const Arrivals output = arrivals("imu");
  const auto sensor = start_sensor("imu", "100");
  ASSERT_TRUE(output.more_arrive(100));
  const auto mad = start_sensor("mad", "10000", "10");
  ASSERT_TRUE(eventually([&] { return of(*daemon, "gyrod_samples_received_total") > kFlood; }));
  ASSERT_TRUE(output.more_arrive(100));
  mad->signal(SIGINT);
  EXPECT_EQ(mad->wait(), 0) << mad->err();
  ASSERT_TRUE(output.more_arrive(100));
  EXPECT_EQ(output.missing(), 0U);
  EXPECT_EQ(of(*daemon, "gyrod_sensor_samples_missing_total{sensor=\"imu\"}"), 0.0);
  expect_balanced(*daemon);
  sensor->signal(SIGINT);
  sensor->wait();
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Faults, ASensorsClockThatIsSetAnHourBackAndForthCostsSevenSamplesAndIsCounted) {
  constexpr std::int64_t kHourNs = 3'600'000'000'000;
  const auto daemon = start_daemon();
  const Arrivals output = arrivals("imu");
  ASSERT_TRUE(eventually([&] { return output.writers() == 1; }));
  bus::RawWriter sensor = writer(*daemon);
  std::vector<stream::Sample> samples = noisy_samples(900);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n].stamp_ns += 10 * kHourNs;
    if (n >= 300) samples[n].stamp_ns += kHourNs;
    if (n >= 600) samples[n].stamp_ns -= 2 * kHourNs;
  }
  send(sensor, "imu", samples);
  ASSERT_TRUE(sensor.end("imu"));
  // The gate believes a clock that is set back with the eighth sample that agrees.
  ASSERT_TRUE(eventually([&] { return output.count() == 893; }));
  EXPECT_EQ(output.missing(), 7U);
  EXPECT_EQ(rejected(*daemon, "time_backwards"), 7.0);
  EXPECT_EQ(of(*daemon, "gyrod_restarts_total"), 2.0);
  EXPECT_EQ(of(*daemon, "gyrod_samples_missing_total"), 0.0);
  expect_balanced(*daemon);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Faults, PayloadsThatAreNotWhatTheirTypeNameSaysHarmNobody) {
  const auto daemon = start_daemon();
  const Arrivals output = arrivals("imu");
  const auto sensor = start_sensor("imu", "100");
  ASSERT_TRUE(output.more_arrive(50));

  // Too short: where rates are expected, nothing is.
  const ForeignWriter batch_as_sample(domain().participant(), gyrod_GyroBatch_desc, "gyrod::GyroSample",
                                      "gyro/raw");
  ASSERT_TRUE(batch_as_sample.wait_for_reader());
  ASSERT_TRUE(eventually([&] { return of(*daemon, "gyrod_bus_matched_writers") == 2.0; }));
  gyrod_GyroBatch batch{};
  std::strcpy(batch.sensor, "short");
  for (int n = 0; n < 50; ++n) batch_as_sample.write(batch);

  // An absurd length: the sequence number is taken for the number of samples.
  const ForeignWriter sample_as_batch(domain().participant(), gyrod_GyroSample_desc, "gyrod::GyroBatch",
                                      "gyro/raw_batch");
  ASSERT_TRUE(sample_as_batch.wait_for_reader());
  ASSERT_TRUE(eventually([&] { return of(*daemon, "gyrod_bus_matched_writers") == 3.0; }));
  gyrod_GyroSample sample{};
  std::strcpy(sample.sensor,
              "far");  // with its length and end eight bytes: the number stands where the length is expected
  for (const std::uint64_t length : {0xffffffffULL, 0x7fffffffULL, 0x10000000ULL, 2ULL}) {
    sample.sequence_number = length;
    for (int n = 0; n < 20; ++n) sample_as_batch.write(sample);
  }

  EXPECT_TRUE(eventually([&] { return of(*daemon, "gyrod_bus_malformed_messages_total") == 50.0 + 80.0; }))
      << of(*daemon, "gyrod_bus_malformed_messages_total") << daemon->err();
  EXPECT_THAT(daemon->err(), HasSubstr("deserialization"));
  ASSERT_TRUE(output.more_arrive(200));
  EXPECT_EQ(output.missing(), 0U);
  EXPECT_EQ(of(*daemon, "gyrod_sensors"), 1.0) << "no sensor was made of it";
  expect_balanced(*daemon);
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Faults, ValuesThatAreNoAngularRatesAreRefusedOneByOne) {
  const auto daemon = start_daemon();
  const Arrivals output = arrivals("imu");
  ASSERT_TRUE(eventually([&] { return output.writers() == 1; }));
  bus::RawWriter sensor = writer(*daemon);
  std::vector<stream::Sample> samples = noisy_samples(400);
  samples[100].rate_radps[1] = std::nan("");
  samples[150].rate_radps[0] = -std::numeric_limits<double>::infinity();
  samples[200].rate_radps[2] = 1e300;
  send(sensor, "imu", samples);
  ASSERT_TRUE(sensor.end("imu"));
  ASSERT_TRUE(eventually([&] { return output.count() == 397; }));
  for (const auto& sample : output.samples()) {
    for (const double rate : sample.rate_radps) ASSERT_LT(std::abs(rate), 1.0) << sample.sequence;
  }
  EXPECT_EQ(rejected(*daemon, "not_finite"), 2.0);
  EXPECT_EQ(rejected(*daemon, "out_of_range"), 1.0);
  expect_balanced(*daemon);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
