// Sensor, daemon and recorder on three hosts, and a network that loses packets or is not there for a while: what is missing is counted
// to the sample, and what was received comes out.
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "hosts.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

constexpr std::size_t kSensor = 1;
constexpr std::size_t kDaemon = 2;
constexpr std::size_t kRecorder = 3;

struct Loss {
  unsigned per_mille;
  const char* reliability;
};

std::string name_of(const ::testing::TestParamInfo<Loss>& info) {
  return std::string(info.param.reliability) + "_" + std::to_string(info.param.per_mille) + "_per_mille";
}

class LossyNetwork : public Hosts {
 protected:
  /// A recorder must not be the one who loses: its writer keeps all there are.
  [[nodiscard]] std::string patch(const std::string& input_reliability) const {
    return R"({"bus": {"input": {"reliability": ")" + input_reliability +
           R"("}, "output": {"history_depth": 8192}}})";
  }

  std::unique_ptr<Process> start_recorder_on(std::size_t host, const std::string& config_file) {
    auto recorder =
        start_on(host, {"record", "--topic", "gyro/denoised", "-o", path("out.csv")}, config_file);
    if (!recorder->wait_for_err("listening"))
      throw std::runtime_error("the recorder does not listen: " + recorder->err());
    return recorder;
  }

  double count(const Process& daemon, const std::string& series) const {
    return metric_on(kDaemon, daemon, series);
  }
};

class AtLoss : public LossyNetwork, public ::testing::WithParamInterface<Loss> {};

/// What the numbers of the samples that came out say about those that did not come in.
struct Holes {
  std::uint64_t missing = 0;
  std::uint64_t bridged = 0;
  std::uint64_t gaps = 0;
};
Holes holes_in(const std::vector<std::uint64_t>& sequences) {
  constexpr std::uint64_t kMostBridged = 16;  // limits.max_bridged_samples
  Holes holes;
  for (std::size_t i = 1; i < sequences.size(); ++i) {
    const std::uint64_t hole = sequences[i] - sequences[i - 1] - 1;
    holes.missing += hole;
    if (hole > kMostBridged) {
      ++holes.gaps;
    } else {
      holes.bridged += hole;
    }
  }
  return holes;
}

TEST_P(AtLoss, WhatIsMissingIsCountedToTheSampleAndTheRestComesOut) {
  constexpr std::uint64_t kSamples = 2000;
  const auto [per_mille, reliability] = GetParam();
  const std::string config = config_of(
      "gyrod", per_mille, {.window_samples = 512, .method = "paper", .patch = patch(reliability)}, 3.0);
  const auto daemon = start_daemon_on(kDaemon, config);
  const auto recorder = start_recorder_on(kRecorder, config);
  const auto sensor = start_on(kSensor,
                               {"simulate", "--sensor", "imu", "--rate", "1000", "--samples",
                                std::to_string(kSamples), "--wait", "60"},
                               config);
  ASSERT_EQ(sensor->wait(), 0) << sensor->err();
  ASSERT_TRUE(eventually([&] {
    return count(*daemon, "gyrod_bus_matched_writers") == 0.0 &&
           count(*daemon, "gyrod_samples_in_flight") == 0.0;
  })) << "the sensor's end is known";

  const double received = count(*daemon, "gyrod_samples_received_total");
  const double published = count(*daemon, "gyrod_samples_published_total");
  const double missing = count(*daemon, "gyrod_samples_missing_total");
  const double bridged = count(*daemon, "gyrod_samples_bridged_total");
  const double gaps = count(*daemon, "gyrod_gaps_total");
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  (void)recorder->wait();  // 6 where numbers are missing
  const std::vector<std::uint64_t> came = sequences_of(path("out.csv"));

  EXPECT_EQ(received, published) << "nothing is refused, all is released";
  EXPECT_EQ(static_cast<double>(came.size()), published);
  const Holes holes = holes_in(came);
  EXPECT_EQ(missing, static_cast<double>(holes.missing));
  EXPECT_EQ(bridged, static_cast<double>(holes.bridged));
  EXPECT_EQ(gaps, static_cast<double>(holes.gaps));
  if (std::string(reliability) == "reliable") {
    EXPECT_EQ(came.size(), kSamples);
    EXPECT_EQ(missing, 0.0);
    return;
  }
  const std::size_t lost = kSamples - came.size();
  if (per_mille == 0) {  // a busy machine's sockets may still lose a packet
    EXPECT_LE(lost, kSamples / 50);
    return;
  }
  // How many samples share a packet is the sender's affair, so the share that is lost is not that of the packets.
  EXPECT_GT(lost, 0U);
  EXPECT_LT(lost, kSamples / 2);
}

/// The length of an outage is what these tests put in; nothing waits for it to be over.
void wait_out(std::chrono::milliseconds outage) { std::this_thread::sleep_for(outage); }

TEST_F(LossyNetwork, AnOutageShorterThanTheLeaseLosesNothing) {
  constexpr std::uint64_t kSamples = 1500;
  const std::string config =
      config_of("gyrod", 0, {.window_samples = 512, .method = "paper", .patch = patch("reliable")});
  const auto daemon = start_daemon_on(kDaemon, config);
  const auto recorder = start_recorder_on(kRecorder, config);
  const auto sensor = start_on(
      kSensor, {"simulate", "--sensor", "imu", "--rate", "500", "--samples", std::to_string(kSamples)},
      config);
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_published_total") > 200.0; }));
  network().set_link(kDaemon, false);
  wait_out(std::chrono::milliseconds{1000});
  network().set_link(kDaemon, true);
  EXPECT_EQ(sensor->wait(), 0) << sensor->err();
  EXPECT_TRUE(eventually([&] {
    return count(*daemon, "gyrod_samples_published_total") == static_cast<double>(kSamples);
  })) << count(*daemon, "gyrod_samples_published_total");
  EXPECT_EQ(count(*daemon, "gyrod_samples_missing_total"), 0.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  EXPECT_EQ(recorder->wait(), 0) << "nothing is missing in the output: " << recorder->err();
  EXPECT_EQ(sequences_of(path("out.csv")).size(), kSamples);
}

/// A sensor that is away for longer than its lease has ended; it is found again, and begins a new window.
TEST_F(LossyNetwork, AnOutageLongerThanTheLeaseEndsTheSensorAndItComesBackByItself) {
  const std::string config =
      config_of("gyrod", 0, {.window_samples = 512, .method = "paper", .patch = patch("reliable")}, 1.0);
  const auto daemon = start_daemon_on(kDaemon, config);
  const auto recorder = start_recorder_on(kRecorder, config);
  const auto sensor = start_on(kSensor, {"simulate", "--sensor", "imu", "--rate", "500"}, config);
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_published_total") > 200.0; }));
  network().set_link(kSensor, false);
  ASSERT_TRUE(eventually([&] {
    return count(*daemon, "gyrod_bus_matched_writers") == 0.0 &&
           count(*daemon, "gyrod_samples_in_flight") == 0.0;
  })) << "what was held of it is released";
  const double before = count(*daemon, "gyrod_samples_published_total");
  network().set_link(kSensor, true);
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_published_total") > before + 500.0; }))
      << "no restart of anything: " << daemon->err();
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0) << sensor->err();
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_in_flight") == 0.0; }));
  const double received = count(*daemon, "gyrod_samples_received_total");
  const double published = count(*daemon, "gyrod_samples_published_total");
  EXPECT_EQ(received, published);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  (void)recorder->wait();
  const std::vector<std::uint64_t> came = sequences_of(path("out.csv"));
  EXPECT_EQ(static_cast<double>(came.size()), published);
  std::size_t holes = 0;
  for (std::size_t i = 1; i < came.size(); ++i) {
    ASSERT_GT(came[i], came[i - 1]) << "nothing twice";
    holes += came[i] > came[i - 1] + 1 ? 1U : 0U;
  }
  EXPECT_LE(holes, 1U) << "the outage, and nothing besides";
}

INSTANTIATE_TEST_SUITE_P(LossyNetwork, AtLoss,
                         ::testing::Values(Loss{0, "reliable"}, Loss{10, "reliable"}, Loss{50, "reliable"},
                                           Loss{200, "reliable"}, Loss{0, "best_effort"},
                                           Loss{10, "best_effort"}, Loss{50, "best_effort"},
                                           Loss{200, "best_effort"}),
                         name_of);

}  // namespace
}  // namespace gyrod::testing
