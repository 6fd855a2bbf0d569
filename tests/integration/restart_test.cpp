// A daemon is killed in the middle of its work and started again.
#include <algorithm>
#include <csignal>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig.hpp"
#include "stream/method.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"
#include "support/slow_build.hpp"

namespace gyrod::testing {
namespace {

using ::testing::HasSubstr;

constexpr unsigned kWarmingUp = 1;
constexpr std::uint64_t kWindow = 512;

class Restart : public Rig {
 protected:
  /// The loopback network with a short lease: the sensor's reliable writer waits for a killed daemon until then.
  Restart() { write_loopback("network.xml", 2); }

  std::unique_ptr<Process> start_without_history() {
    return start_daemon({.window_samples = kWindow, .patch = R"({"bus": {"network": "network.xml"}})"});
  }
  /// A daemon that reads what sensors keep, and remembers what it has published.
  std::unique_ptr<Process> start_with_history() {
    const std::string patch =
        R"({"bus": {"network": "network.xml", "input": {"durability": "transient_local"}},
            "restart": {"published_file": "published"}})";
    return start_daemon({.window_samples = kWindow, .patch = patch});
  }
  std::unique_ptr<Process> start_sensor(const std::string& keep) {
    return start_on_bus(
        {"simulate", "--sensor", "imu", "--rate", "500", "--batch", "5", "--keep", keep, "--wait", "60"});
  }
  [[nodiscard]] Arrivals arrivals() const {
    return {bus::Domain(domain_id(), path("network.xml")), bus::BusOptions{}, "gyro/denoised", "imu"};
  }
  static bool has_published(const Process& daemon, double samples) {
    return eventually(
        [&] { return metric(daemon, "gyrod_samples_published_total").value_or(0.0) >= samples; });
  }
  static double history(const Process& daemon) {
    return metric(daemon, "gyrod_samples_rejected_total{reason=\"history\"}").value_or(-1.0);
  }
  static void kill_now(Process& daemon) {
    daemon.signal(SIGKILL);
    daemon.wait();
  }
};

// The sensor keeps more than two windows, and more than it sends until the next daemon is there.
TEST_F(Restart, KilledAtAnyMomentItGoesOnWhereItWasWithFullWindowsIfTheSensorKeepsItsHistory) {
  auto daemon = start_with_history();
  EXPECT_THAT(daemon->err(), HasSubstr("0 sensors were published before this start"));
  const Arrivals output = arrivals();
  const auto sensor = start_sensor("5000");
  ASSERT_TRUE(eventually([&] { return output.writers() == 1; }));
  // Moments that are neither multiples of the hop nor of the window.
  for (const double moment : {301.0, 77.0, 523.0}) {
    ASSERT_TRUE(has_published(*daemon, moment)) << daemon->err();
    kill_now(*daemon);
    daemon = start_with_history();
    EXPECT_THAT(daemon->err(), HasSubstr("1 sensors were published before this start"));
    ASSERT_TRUE(eventually([&] { return history(*daemon) > 0.0; }));
  }
  ASSERT_TRUE(has_published(*daemon, 500.0));
  EXPECT_TRUE(daemon->wait_for_err("that were published before fill windows")) << daemon->err();
  // The sensor would wait for the killed readers' leases before it ends.
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  sensor->signal(SIGKILL);

  EXPECT_EQ(output.missing(), 0U) << "nothing that the sensor kept is lost";
  EXPECT_EQ(output.samples().front().sequence, 0U);
  // What was sent and not noted yet when the process was killed: one release each time at the most, long where it was catching up.
  EXPECT_LE(output.duplicates(), 3 * stream::kMaxModelReleaseSamples) << output.jumps();
  for (const auto& sample : output.samples()) {
    if (sample.sequence < kWindow) continue;
    ASSERT_EQ(sample.flags & kWarmingUp, 0U) << sample.sequence;
  }
}

TEST_F(Restart, WithoutHistoryItWarmsUpAndOnlyWhatWasInFlightAndWhatWasSentMeanwhileIsMissing) {
  auto daemon = start_without_history();
  const double started = metric(*daemon, "process_start_time_seconds").value_or(0.0);
  const Arrivals output = arrivals();
  const auto sensor = start_sensor("0");
  ASSERT_TRUE(has_published(*daemon, 600.0));
  kill_now(*daemon);
  daemon = start_without_history();
  ASSERT_TRUE(has_published(*daemon, 600.0));
  EXPECT_GT(metric(*daemon, "process_start_time_seconds").value_or(0.0), started) << "counters began anew";
  EXPECT_EQ(history(*daemon), 0.0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
  sensor->signal(SIGKILL);

  const auto samples = output.samples();
  const auto anew = std::ranges::adjacent_find(
      samples, [](const auto& a, const auto& b) { return b.sequence != a.sequence + 1; });
  ASSERT_NE(anew, samples.end()) << "samples in flight were lost with the process";
  EXPECT_LT(anew->sequence, std::next(anew)->sequence);
  EXPECT_NE(std::next(anew)->flags & kWarmingUp, 0U);
  EXPECT_LE(std::next(anew)->model_epoch, anew->model_epoch) << "a reader sees the restart";
  EXPECT_EQ(output.duplicates(), 0U);
  EXPECT_EQ(
      std::ranges::adjacent_find(std::next(anew), samples.end(),
                                 [](const auto& a, const auto& b) { return b.sequence != a.sequence + 1; }),
      samples.end())
      << "one hole";
}

// To DDS it is a new reader then, and gets all that the sensor keeps once more.
TEST_F(Restart, PausedForLongerThanTheLeaseItPublishesNothingFromBeforeAgainAndTakesTheRest) {
  const auto daemon = start_with_history();
  const Arrivals output = arrivals();
  const auto sensor = start_sensor("5000");
  ASSERT_TRUE(has_published(*daemon, 1000.0));
  daemon->signal(SIGSTOP);
  ASSERT_TRUE(eventually([&] { return output.writers() == 0; })) << "its lease ends for the sensor, too";
  const std::uint64_t seen = output.samples().back().sequence;
  daemon->signal(SIGCONT);
  ASSERT_TRUE(output.more_arrive(1000));
  EXPECT_TRUE(eventually([&] { return is_balanced(*daemon); }));
  EXPECT_EQ(of(*daemon, "gyrod_samples_missing_total"), 0.0);
  sensor->signal(SIGINT);
  sensor->wait();
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  // In a build so slow that the reader is not found within half a second, what leaves meanwhile is not its own.
  if (!kSlowBuild) {
    EXPECT_EQ(output.missing(), 0U) << output.jumps();
  }
  // What waited during the pause may come twice, where the reader is found before the sensor is lost; what had left before it does not.
  const auto samples = output.samples();
  EXPECT_EQ(std::ranges::count_if(samples, [seen](const auto& one) { return one.sequence <= seen; }),
            static_cast<std::ptrdiff_t>(seen) + 1)
      << output.jumps();
}

TEST_F(Restart, AnEndedSensorThatIsSentAgainIsPublishedAgain) {
  write_file("short.csv", noisy_recording(300));
  for (const std::string out : {"first.csv", "second.csv"}) {
    const auto daemon = start_with_history();
    const auto recorder = start_recorder(out, {"--until-end"});
    ASSERT_EQ(run_on_bus({"replay", path("short.csv"), "--sensor", "imu", "--speed", "max", "--keep", "300",
                          "--wait", "60"})
                  .exit_code,
              0);
    EXPECT_EQ(recorder->wait(), 0) << recorder->err();
    EXPECT_EQ(columns_of(path(out), {"sequence"}).size(), 300U);
    EXPECT_EQ(stop_daemon(*daemon), 0);
  }
}

}  // namespace
}  // namespace gyrod::testing
