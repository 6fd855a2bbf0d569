// Two daemons with the same output, as two processes, and what a subscriber sees when one of them goes.
#include <csignal>
#include <string>

#include <gtest/gtest.h>

#include "standby_pair.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"
#include "support/slow_build.hpp"

namespace gyrod::testing {
namespace {

class Standby : public StandbyPair {
 protected:
  /// A build that is slow keeps a daemon waiting for half a second.
  Standby() { takeover_s_ = kSlowBuild ? 1.0 : 0.5; }
  [[nodiscard]] Arrivals arrivals() const {
    bus::BusOptions options;
    options.ownership_strength = 1;
    return {bus::Domain(domain_id(), "loopback"), options, "gyro/denoised", "imu"};
  }
  std::unique_ptr<Process> start_sensor() {
    return start_on_bus({"simulate", "--sensor", "imu", "--rate", "200", "--wait", "60"});
  }
  /// Both have the sensor, the first publishes it, the second holds.
  void wait_for_duty(const Arrivals& output) {
    ASSERT_TRUE(output.more_arrive(200));
    ASSERT_TRUE(eventually([&] {
      return of(*second_, "gyrod_standby_samples_let_go_total") > 100.0 && publishes(*first_, 1.0) &&
             publishes(*second_, 0.0);
    }));
  }
  /// Some more samples, none missing, and an orderly end of all three.
  void end_without_loss(const Arrivals& output, Process& sensor) {
    ASSERT_TRUE(output.more_arrive(200));
    EXPECT_EQ(output.missing(), 0U) << output.jumps();
    RecordProperty("duplicates", static_cast<int>(output.duplicates()));
    sensor.signal(SIGINT);
    sensor.wait();
    EXPECT_EQ(stop_daemon(*first_), 0);
    EXPECT_EQ(stop_daemon(*second_), 0);
  }
};

TEST_F(Standby, GoesOnWithTheSampleThatWouldHaveComeNextAndWithTheSameBitsWhenTheOtherIsKilled) {
  ASSERT_EQ(run({"simulate", "--rate", "200", "--samples", "1000", "-o", path("still.csv")}).exit_code, 0);
  start_two();
  const Arrivals output = arrivals();
  ASSERT_TRUE(eventually([&] { return output.writers() == 2; }));
  const auto sensor = start_on_bus({"replay", path("still.csv"), "--sensor", "imu", "--wait", "60"});
  wait_for_duty(output);
  first_->signal(SIGKILL);
  // The last 16, the lag, leave at the sensor's end, for which its writer waits until the killed reader's lease is over.
  ASSERT_TRUE(eventually([&] { return output.samples().back().sequence >= 983; }));
  EXPECT_EQ(output.missing(), 0U) << output.jumps();
  EXPECT_EQ(output.samples().front().sequence, 0U);
  RecordProperty("longest_pause_ms", static_cast<int>(1000.0 * output.longest_pause_s()));
  EXPECT_GE(output.longest_pause_s(), 0.25);
  // On a machine that is so slow that the first looked dead before, also before anything was heard of it, there are more.
  ASSERT_GE(of(*second_, "gyrod_standby_takeovers_total"), 1.0);
  if (!kSlowBuild && of(*second_, "gyrod_standby_takeovers_total") == 1.0) {
    EXPECT_LE(output.duplicates(), 2U) << "sent by the first and not heard by the second before the end";
  }

  const Result offline =
      run({"denoise", path("still.csv"), "-o", path("offline.csv"), "--config", path(kFirst)});
  ASSERT_EQ(offline.exit_code, 0) << offline.err;
  const auto expected = columns_of(path("offline.csv"), {"gyro_x_radps"});
  for (const auto& sample : output.samples())
    ASSERT_EQ(sample.rate_radps[0], std::stod(expected.at(sample.sequence))) << sample.sequence;
}

TEST_F(Standby, GivesBackWithoutASeamWhenTheStrongerOneIsBack) {
  start_two();
  const Arrivals output = arrivals();
  const auto sensor = start_sensor();
  wait_for_duty(output);
  first_->signal(SIGTERM);
  EXPECT_EQ(first_->wait(), 0) << first_->err();
  ASSERT_TRUE(eventually([&] { return publishes(*second_, 1.0); }));
  ASSERT_TRUE(output.more_arrive(100));
  first_ = start_one(kFirst);
  ASSERT_TRUE(eventually([&] { return publishes(*first_, 1.0) && publishes(*second_, 0.0); }))
      << first_->err();
  end_without_loss(output, *sensor);
}

TEST_F(Standby, StandsInForOneThatIsStoppedForAWhileAndNothingIsMissing) {
  start_two();
  const Arrivals output = arrivals();
  const auto sensor = start_sensor();
  wait_for_duty(output);
  first_->signal(SIGSTOP);
  ASSERT_TRUE(eventually([&] { return of(*second_, "gyrod_standby_takeovers_total") >= 1.0; }));
  ASSERT_TRUE(output.more_arrive(200));
  first_->signal(SIGCONT);
  ASSERT_TRUE(eventually([&] { return publishes(*first_, 1.0) && publishes(*second_, 0.0); }));
  end_without_loss(output, *sensor);
}

// Under method paper a daemon releases a hop at a time, of a slow sensor every 0.4 s, and those of one that came later end at other samples:
// what one has released the other may have in its window still.
TEST_F(Standby, MissesNothingOfASlowSensorWhoseHopsDifferWhenTheOtherIsKilledAndComesBack) {
  constexpr int kRounds = 3;
  write_loopback("network.xml", 2);  // the sensor waits for a killed daemon until then
  options_.method = "paper";
  options_.patch = R"({"bus": {"network": "network.xml"}})";
  start_two();
  bus::BusOptions exclusive;
  exclusive.ownership_strength = 1;
  const Arrivals output(bus::Domain(domain_id(), path("network.xml")), exclusive, "gyro/denoised", "slow");
  ASSERT_TRUE(eventually([&] { return output.writers() == 2; }));
  const auto sensor = start_on_bus({"simulate", "--sensor", "slow", "--rate", "77", "--wait", "60"});
  for (int round = 0; round < kRounds; ++round) {
    ASSERT_TRUE(eventually([&] { return publishes(*first_, 1.0) && publishes(*second_, 0.0); }));
    // The kill comes with a hop of the first, and the second holds since its own.
    ASSERT_TRUE(output.more_arrive(40));
    first_->signal(SIGKILL);
    first_->wait();
    ASSERT_TRUE(eventually([&] { return publishes(*second_, 1.0); }));
    first_ = start_one(kFirst);
  }
  ASSERT_TRUE(eventually([&] { return publishes(*first_, 1.0) && publishes(*second_, 0.0); }));
  ASSERT_TRUE(output.more_arrive(40));
  EXPECT_EQ(output.missing(), 0U) << output.jumps();
  EXPECT_EQ(output.samples().front().sequence, 0U);
  EXPECT_EQ(stop_daemon(*first_), 0) << first_->err();
  EXPECT_EQ(stop_daemon(*second_), 0) << second_->err();
  sensor->signal(SIGKILL);
}

}  // namespace
}  // namespace gyrod::testing
