#include <csignal>
#include <string>

#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/slow_build.hpp"

namespace gyrod::testing {
namespace {

/// What a flood leaves in the cache has to be denoised before the end; a sanitizer's build is slow.
constexpr std::size_t kFewMessages = 256;

class Drain : public Rig {
 protected:
  /// Starts a sensor that sends as fast as it can, and waits until the daemon has published some of it.
  std::unique_ptr<Process> flood(const Process& daemon) {
    auto sensor = start_on_bus({"simulate", "--speed", "max", "--batch", "16"});
    constexpr double kSome = kSlowBuild ? 700.0 : 2000.0;
    EXPECT_TRUE(
        eventually([&] { return metric(daemon, "gyrod_samples_published_total").value_or(0.0) > kSome; }));
    return sensor;
  }

  /// The counts that the daemon logs when it has stopped.
  struct Counts {
    unsigned long long received = 0;
    unsigned long long published = 0;
    unsigned long long rejected = 0;
    unsigned long long in_flight = 1;
  };
  static Counts counts_of(const Process& daemon) {
    Counts counts;
    const std::string log = daemon.err();
    const std::size_t at = log.find("stopped: ");
    if (at == std::string::npos) return counts;
    std::sscanf(log.c_str() + at,
                "stopped: %llu samples received, %llu published, %llu rejected, %llu in flight",
                &counts.received, &counts.published, &counts.rejected, &counts.in_flight);
    return counts;
  }
};

TEST_F(Drain, SigtermInTheMiddleOfAStreamLosesNothing) {
  const auto daemon = start_daemon({.max_messages = kFewMessages});
  const auto recorder = start_recorder("out.csv", {});
  const auto sensor = flood(*daemon);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  ASSERT_EQ(recorder->wait(), 0) << "ends with the daemon, and no sequence number is missing: "
                                 << recorder->err();
  const Counts counts = counts_of(*daemon);
  EXPECT_EQ(counts.received, counts.published + counts.rejected);
  EXPECT_EQ(counts.in_flight, 0U);
  const auto rows = columns_of(path("out.csv"), {"sequence"});
  EXPECT_EQ(rows.size(), counts.published);
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.front(), "0");
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0) << sensor->err();
}

TEST_F(Drain, AStopThatMeetsItsDeadlinePassesTheRestThroughAndSaysSo) {
  // Method joint has no pass-through: it goes on with older models.
  const auto daemon = start_daemon({.stop_deadline_s = 0.0, .max_messages = kFewMessages, .method = "paper"});
  const auto recorder = start_recorder("out.csv", {});
  const auto sensor = flood(*daemon);
  EXPECT_EQ(stop_daemon(*daemon), 6) << daemon->err();
  ASSERT_EQ(recorder->wait(), 0) << recorder->err();
  const Counts counts = counts_of(*daemon);
  EXPECT_EQ(counts.received, counts.published + counts.rejected);
  const auto flags = columns_of(path("out.csv"), {"flags"});
  EXPECT_EQ(flags.size(), counts.published);
  constexpr unsigned long kPassThrough = 4;
  EXPECT_NE(std::stoul(flags.back()) & kPassThrough, 0U);
  sensor->signal(SIGTERM);
  EXPECT_EQ(sensor->wait(), 0);
}

TEST_F(Drain, AnEndedSensorIsFlushedAndMayComeBack) {
  write_file("short.csv", noisy_recording(100));
  // Method joint remembers how the noise was before the end, so that its second answers are others.
  const auto daemon = start_daemon({.method = "paper"});
  for (const std::string out : {"first.csv", "second.csv"}) {
    const auto recorder = start_recorder(out, {"--until-end"});
    ASSERT_EQ(run_on_bus({"replay", path("short.csv"), "--sensor", "imu", "--speed", "max"}).exit_code, 0);
    ASSERT_EQ(recorder->wait(), 0) << recorder->err();
    EXPECT_EQ(columns_of(path(out), {"sequence"}).size(), 100U);
  }
  EXPECT_EQ(columns_of(path("first.csv"), {"gyro_x_radps"}),
            columns_of(path("second.csv"), {"gyro_x_radps"}));
  EXPECT_EQ(metric(*daemon, "gyrod_bus_write_errors_total"), 0.0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Drain, TheCountsAddUpAtEveryMoment) {
  const auto daemon = start_daemon({.max_messages = kFewMessages});
  const auto sensor = flood(*daemon);
  for (int look = 0; look < 20; ++look) {
    // One scrape is one moment.
    std::stringstream text(get(*daemon, "/metrics"));
    double received = 0.0;
    double accounted = 0.0;
    for (std::string line; std::getline(text, line);) {
      const auto value = [&line] { return std::stod(line.substr(line.rfind(' '))); };
      if (line.starts_with("gyrod_samples_received_total ")) received = value();
      if (line.starts_with("gyrod_samples_published_total ") ||
          line.starts_with("gyrod_samples_in_flight ") || line.starts_with("gyrod_samples_rejected_total{")) {
        accounted += value();
      }
    }
    EXPECT_GT(received, 0.0);
    EXPECT_EQ(received, accounted);
  }
  sensor->signal(SIGTERM);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
