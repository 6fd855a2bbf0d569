// A ROS 2 topic that goes from one daemon to another and back, and what a subscription gets of it.
#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "fleet/shard.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/imu_driver.hpp"

namespace gyrod::testing {
namespace {

constexpr const char* kTopic = "rt/imu/data_raw";
constexpr std::size_t kLag = 16;

/// Two daemons' messages come in no particular order.
std::vector<ImuMessage> by_stamp(std::vector<ImuMessage> messages) {
  std::ranges::stable_sort(messages, {}, [](const ImuMessage& message) { return stamp_ns_of(message); });
  return messages;
}

class Ros2Shards : public Rig {
 protected:
  /// @param shard none where it is empty
  std::unique_ptr<Process> start_one(const std::string& shard) {
    const std::string entry = shard.empty() ? "" : R"("shard": ")" + shard + R"(", )";
    const std::string name = shard.empty() ? "alone.json" : "shard.json";
    write_config({.window_samples = 512,
                  .patch = R"({"bus": {)" + entry + R"("ros2": {"topics": [")" + kTopic + R"("]}}})"},
                 name);
    auto daemon = start({"run", "--config", path(name)});
    if (!daemon->wait_for_err("/metrics")) throw std::runtime_error(daemon->err());
    return daemon;
  }
  [[nodiscard]] bool more_come(std::size_t messages) {
    const std::size_t from = denoised_.messages().size();
    return denoised_.wait_for(from + messages) && realtime_.wait_for(from + messages);
  }
  [[nodiscard]] static double published(const Process& daemon) {
    return of(daemon, "gyrod_samples_published_total");
  }

  bus::Domain domain_{domain_id(), "loopback"};
  ImuSubscription denoised_{domain_.participant(), "rt/imu/data_denoised"};
  ImuSubscription realtime_{domain_.participant(), "rt/imu/data_realtime"};
  ImuDriver driver_{domain_.participant(), kTopic, noisy_imu_messages(20'000)};
};

TEST_F(Ros2Shards, EachMessageComesOnceWhileItsTopicChangesHands) {
  const auto alone = start_one("");
  ASSERT_TRUE(
      eventually([&] { return denoised_.matched_writers() == 1 && realtime_.matched_writers() == 1; }));
  ASSERT_TRUE(eventually([&] {
    return of(*alone, "gyrod_bus_matched_writers") == 1.0 && has_reader(*alone, "rt/imu/data_denoised") &&
           has_reader(*alone, "rt/imu/data_realtime");
  }));
  driver_.start();
  ASSERT_TRUE(more_come(700));
  const std::string shard = fleet::holds({1, 2}, kTopic) ? "1/2" : "2/2";
  const auto other = start_one(shard);
  ASSERT_TRUE(eventually([&] { return published(*other) > 300.0; })) << other->err();
  EXPECT_EQ(stop_daemon(*other), 0) << other->err();
  const double before = published(*alone);
  ASSERT_TRUE(eventually([&] { return published(*alone) > before + 300.0; }));

  const std::vector<ImuMessage> sent = driver_.stop();
  ASSERT_TRUE(eventually([&] {
    return stamp_ns_of(realtime_.messages().back()) == stamp_ns_of(sent.back()) &&
           stamp_ns_of(denoised_.messages().back()) == stamp_ns_of(sent[sent.size() - 1 - kLag]);
  }));
  EXPECT_EQ(expect_all(by_stamp(denoised_.messages()), {sent.begin(), sent.end() - kLag}), 0U);
  EXPECT_EQ(expect_all(by_stamp(realtime_.messages()), sent), 0U);
  EXPECT_EQ(of(*alone, "gyrod_ros2_dropped_messages_total"), 0.0);
  EXPECT_EQ(stop_daemon(*alone), 0) << alone->err();
}

}  // namespace
}  // namespace gyrod::testing
