// Daemons on several hosts that share the sensors by `bus.shard`: each sensor is served exactly once, also while the count changes.
#include <algorithm>
#include <csignal>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fleet/shard.hpp"
#include "hosts.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

constexpr std::size_t kSensorHost = 1;
constexpr std::size_t kRecorderHost = 5;
constexpr std::size_t kSensors = 12;
constexpr double kRateHz = 100.0;

using Sequences = std::map<std::string, std::vector<std::uint64_t>>;

/// The numbers of each sensor in a recording, sorted: two daemons' samples come in no particular order.
Sequences sorted_sequences(const std::string& file) {
  Sequences all;
  for (const std::string& row : columns_of(file, {"sensor", "sequence"})) {
    const std::size_t comma = row.find(',');
    all[row.substr(0, comma)].push_back(std::stoull(row.substr(comma + 1)));
  }
  for (auto& [sensor, sequences] : all) std::ranges::sort(sequences);
  return all;
}

void expect_none_twice(const Sequences& all) {
  for (const auto& [sensor, sequences] : all)
    EXPECT_EQ(std::ranges::adjacent_find(sequences), sequences.end()) << sensor << ": a number came twice";
}

std::string sensor_name(std::size_t number) { return "imu_" + std::to_string(number); }

std::size_t sensors_in(const fleet::Shard& shard) {
  std::size_t count = 0;
  for (std::size_t k = 1; k <= kSensors; ++k) count += fleet::holds(shard, sensor_name(k)) ? 1U : 0U;
  return count;
}

class Shards : public Hosts {
 protected:
  double lease_s_ = 2.0;

  std::string shard_config(const std::string& shard, unsigned lost_per_mille = 0) const {
    std::string name = "shard" + shard;
    std::ranges::replace(name, '/', '-');
    return config_of(
        name, lost_per_mille,
        {.window_samples = 512,
         .method = "paper",
         .patch = R"({"bus": {"shard": ")" + shard + R"(", "output": {"history_depth": 8192}}})"},
        lease_s_);
  }

  std::unique_ptr<Process> start_shard(std::size_t host, const std::string& shard,
                                       unsigned lost_per_mille = 0) {
    return start_daemon_on(host, shard_config(shard, lost_per_mille));
  }

  [[nodiscard]] bool serves(std::size_t host, const Process& daemon, const std::string& shard) const {
    return metric_on(host, daemon, "gyrod_shard_active{shard=\"" + shard + "\"}") == 1.0;
  }

  std::unique_ptr<Process> start_recorder_here(unsigned lost_per_mille = 0) {
    auto recorder = start_on(kRecorderHost, {"record", "--topic", "gyro/denoised", "-o", path("out.csv")},
                             config_of("recorder", lost_per_mille, {}, lease_s_));
    if (!recorder->wait_for_err("listening")) throw std::runtime_error(recorder->err());
    return recorder;
  }

  std::unique_ptr<Process> start_sensors(const std::vector<std::string>& length,
                                         unsigned lost_per_mille = 0) {
    std::vector<std::string> arguments = {"simulate",
                                          "--sensor",
                                          "imu",
                                          "--sensors",
                                          std::to_string(kSensors),
                                          "--rate",
                                          std::to_string(kRateHz),
                                          "--wait",
                                          "60"};
    arguments.insert(arguments.end(), length.begin(), length.end());
    return start_on(kSensorHost, arguments, config_of("sensors", lost_per_mille, {}, lease_s_));
  }
};

TEST_F(Shards, ThreeDaemonsServeEachSensorExactlyOnceAtFivePercentLoss) {
  constexpr std::size_t kSamples = 200;
  constexpr unsigned kLoss = 50;
  std::vector<std::unique_ptr<Process>> daemons;
  for (std::size_t i = 1; i <= 3; ++i) daemons.push_back(start_shard(1 + i, std::to_string(i) + "/3", kLoss));
  for (std::size_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(eventually([&] {
      return metric_on(1 + i, *daemons[i - 1], "gyrod_shard_peers") == 2.0 &&
             metric_on(1 + i, *daemons[i - 1], "gyrod_shards_missing") == 0.0;
    })) << i;
  }
  const auto recorder = start_recorder_here(kLoss);
  for (std::size_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(eventually([&] {
      return metric_on(1 + i, *daemons[i - 1], "gyrod_bus_matched_readers{topic=\"gyro/denoised\"}") == 1.0;
    })) << "what is sent before the recorder is found is not for it: "
        << i;
  }
  const auto sensors = start_sensors({"--samples", std::to_string(kSamples)}, kLoss);
  ASSERT_EQ(sensors->wait(), 0) << sensors->err();

  for (std::size_t i = 1; i <= 3; ++i) {
    const Process& daemon = *daemons[i - 1];
    const auto count = [&](const std::string& series) { return metric_on(1 + i, daemon, series); };
    const double own = static_cast<double>(kSamples * sensors_in({static_cast<std::uint32_t>(i), 3}));
    EXPECT_TRUE(eventually([&] { return count("gyrod_samples_published_total") == own; }))
        << i << ": " << count("gyrod_samples_published_total") << " of " << own;
    EXPECT_EQ(count("gyrod_samples_received_total"), own) << "what is of others is not received";
    EXPECT_EQ(count("gyrod_shard_foreign_samples_total"), kSamples * kSensors - own);
    EXPECT_EQ(count("gyrod_shard_disputes_total"), 0.0);
  }
  for (const auto& daemon : daemons) EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  (void)recorder->wait();
  const Sequences all = sorted_sequences(path("out.csv"));
  EXPECT_EQ(all.size(), kSensors);
  expect_none_twice(all);
  for (const auto& [sensor, sequences] : all) EXPECT_EQ(sequences.size(), kSamples) << sensor;
}

/// A short lease is noticed soon, but is nothing for a network that loses the packets by which a host is known to be there.
struct Change {
  unsigned lost_per_mille;
  double lease_s;
  int signal;  ///< by which a daemon ends
};

class WhileTheCountChanges : public Shards, public ::testing::WithParamInterface<Change> {};

/// One daemon without a shard; then 2/2 beside it; then 1/2; then 2/2 ends, and the first takes what it leaves.
TEST_P(WhileTheCountChanges, EachSampleComesOnceButForWhatAKilledDaemonHeld) {
  const auto [loss, lease_s, end] = GetParam();
  lease_s_ = lease_s;
  const auto alone = start_shard(2, "", loss);
  const auto recorder = start_recorder_here(loss);
  const auto sensors = start_sensors({}, loss);
  const auto served_here = [&](std::size_t host, const Process& daemon) {
    return metric_on(host, daemon, "gyrod_samples_published_total");
  };
  ASSERT_TRUE(eventually([&] { return served_here(2, *alone) > 100.0; }));

  const auto second = start_shard(3, "2/2", loss);
  ASSERT_TRUE(eventually([&] { return served_here(3, *second) > 0.0; })) << second->err();
  const auto first = start_shard(4, "1/2", loss);
  ASSERT_TRUE(eventually([&] { return served_here(4, *first) > 0.0; })) << first->err();
  ASSERT_TRUE(eventually([&] { return metric_on(2, *alone, "gyrod_samples_in_flight") == 0.0; }))
      << "nothing is left to it";
  EXPECT_EQ(metric_on(2, *alone, "gyrod_shard_overlapping_peers"), 2.0);
  EXPECT_EQ(metric_on(2, *alone, "gyrod_shards_missing"), 0.0);
  const double second_disputes = metric_on(3, *second, "gyrod_shard_disputes_total");
  second->signal(end);
  const double before = served_here(2, *alone);
  EXPECT_TRUE(eventually([&] { return served_here(2, *alone) > before; }))
      << "who was there before takes what nobody else serves: " << alone->err();
  sensors->signal(SIGINT);
  EXPECT_EQ(sensors->wait(), 0) << sensors->err();
  const double disputes = second_disputes + metric_on(2, *alone, "gyrod_shard_disputes_total") +
                          metric_on(4, *first, "gyrod_shard_disputes_total");
  for (const auto* daemon : {&alone, &first}) EXPECT_EQ(stop_daemon(**daemon), 0) << (*daemon)->err();
  recorder->signal(SIGINT);
  (void)recorder->wait();

  const Sequences all = sorted_sequences(path("out.csv"));
  EXPECT_EQ(all.size(), kSensors);
  expect_none_twice(all);
  EXPECT_EQ(disputes, 0.0);
  for (const auto& [sensor, sequences] : all) {
    std::uint64_t holes = 0;
    std::uint64_t longest = 0;
    for (std::size_t k = 1; k < sequences.size(); ++k) {
      const std::uint64_t hole = sequences[k] - sequences[k - 1] - 1;
      holes += hole > 0 ? 1U : 0U;
      longest = std::max(longest, hole);
    }
    RecordProperty("longest_hole_" + sensor, static_cast<int>(longest));
    // Bounds of docs/fleet.md: who is stopped or yields hands over. What a daemon that is killed held is lost, and what comes until its
    // lease has ended; a second for a machine that is busy with other things. At 20 % loss a daemon that joins may not hear a sensor yet.
    const bool killed = end == SIGKILL && fleet::holds({2, 2}, sensor);
    const bool deaf = loss >= 200;
    EXPECT_LE(holes, killed ? 1U : deaf ? 2U : 0U) << sensor;
    EXPECT_LE(static_cast<double>(longest) / kRateHz, killed ? lease_s + 2.0 : deaf ? 5.0 : 0.0) << sensor;
  }
}

std::string name_of(const ::testing::TestParamInfo<Change>& change) {
  return std::string(change.param.signal == SIGKILL ? "killed" : "stopped") + "_at_" +
         std::to_string(change.param.lost_per_mille) + "_per_mille";
}
INSTANTIATE_TEST_SUITE_P(Shards, WhileTheCountChanges,
                         ::testing::Values(Change{0, 2.0, SIGKILL}, Change{0, 10.0, SIGTERM},
                                           Change{10, 10.0, SIGTERM}, Change{50, 10.0, SIGTERM},
                                           Change{200, 10.0, SIGTERM}),
                         name_of);

TEST_F(Shards, AShardThatIsServedTwiceAndOneThatIsNotAreTold) {
  const auto first = start_shard(2, "1/2");
  const auto twin = start_shard(3, "1/2");
  const std::vector<std::pair<std::size_t, Process*>> both = {{2, first.get()}, {3, twin.get()}};
  for (const auto& [host, daemon] : both) {
    ASSERT_TRUE(eventually([&] { return metric_on(host, *daemon, "gyrod_shard_twins") == 1.0; }));
    EXPECT_EQ(metric_on(host, *daemon, "gyrod_shards_missing"), 1.0);
    EXPECT_TRUE(daemon->wait_for_err("shard 1/2: served by 1 other daemons as well"));
    EXPECT_TRUE(daemon->wait_for_err("shard 1/2: nobody serves 1 of the shards"));
  }
  EXPECT_EQ(stop_daemon(*twin), 0);
  EXPECT_TRUE(eventually([&] { return metric_on(2, *first, "gyrod_shard_twins") == 0.0; }));
  const auto second = start_shard(3, "2/2");
  EXPECT_TRUE(first->wait_for_err("shard 1/2: every shard is served"));
}

TEST_F(Shards, ARos2TopicOfAnotherShardIsNotOpened) {
  const std::vector<std::string> topics = {"rt/a/imu", "rt/b/imu", "rt/c/imu", "rt/d/imu"};
  const auto own = std::ranges::count_if(topics, [](const auto& topic) {
    return fleet::holds({1, 2}, topic);
  });
  ASSERT_GT(own, 0);
  ASSERT_LT(own, 4);
  const auto daemon = start_daemon(
      {.patch =
           R"({"bus": {"shard": "1/2", "ros2": {"topics": ["rt/a/imu", "rt/b/imu", "rt/c/imu", "rt/d/imu"]}}})"});
  EXPECT_EQ(metric(*daemon, "gyrod_ros2_topics"), static_cast<double>(own));
}

}  // namespace
}  // namespace gyrod::testing
