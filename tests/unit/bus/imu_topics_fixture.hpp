/// ROS 2 topics, a publisher of theirs, and a handler that stands for the engine.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "bus/imu_subscriber.hpp"
#include "bus/imu_topics.hpp"
#include "support/imu_node.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {

/// Accepts what is not negative on x; what is negative on y another daemon serves.
class ImuTopicsHandler final : public ImuHandler {
 public:
  Fate on_sample(std::string_view sensor, const stream::Sample& sample) noexcept override {
    collector_.add(sensor, {&sample, 1});
    if (sample.rate_radps[0] < 0.0) return Fate::kDoesNot;
    return sample.rate_radps[1] < 0.0 ? Fate::kMayLeave : Fate::kLeaves;
  }
  void on_end(std::string_view sensor) noexcept override { collector_.end(sensor); }
  void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept override {
    collector_.break_promise(sensor, why);
  }
  void on_topic(std::string_view topic, const ros2::Outputs& /*outputs*/) noexcept override {
    const std::lock_guard lock(mutex_);
    opened_.emplace_back(topic);
  }
  void on_refused_topic(std::string_view reason) noexcept override {
    const std::lock_guard lock(mutex_);
    refused_.emplace_back(reason);
  }

  [[nodiscard]] Collector<stream::Sample>& collector() { return collector_; }
  [[nodiscard]] std::vector<std::string> opened() {
    const std::lock_guard lock(mutex_);
    return opened_;
  }
  [[nodiscard]] std::vector<std::string> refused() {
    const std::lock_guard lock(mutex_);
    return refused_;
  }

 private:
  std::mutex mutex_;
  Collector<stream::Sample> collector_;
  std::vector<std::string> opened_;
  std::vector<std::string> refused_;
};

class ImuTopicsTest : public BusTest {
 protected:
  ImuTopicsTest() { options_.realtime = true; }

  [[nodiscard]] std::string topic(const std::string& name) const { return prefix_ + name; }

  /// A publisher that the topics know of, too.
  [[nodiscard]] std::unique_ptr<testing::ImuPublisher> publisher(const ImuTopics& topics,
                                                                 const std::string& name) {
    const std::size_t before = topics.snapshot().matched_writers;
    auto made = std::make_unique<testing::ImuPublisher>(writer_domain_.participant(), topic(name));
    EXPECT_TRUE(made->wait_for_reader());
    wait_until([&] { return topics.snapshot().matched_writers == before + 1; });
    settle(writer_domain_, reader_domain_);
    return made;
  }

  /// A subscription that the topics know of, too: they send nothing to one that they have not found.
  [[nodiscard]] std::unique_ptr<testing::ImuSubscription> subscription(const ImuTopics& topics,
                                                                       const std::string& name) {
    auto made = std::make_unique<testing::ImuSubscription>(writer_domain_.participant(), topic(name));
    EXPECT_TRUE(made->wait_for_writer());
    wait_until([&] {
      const std::vector<TopicReaders> known = topics.snapshot().matched_readers;
      return std::ranges::any_of(
          known, [&](const TopicReaders& of) { return of.topic == topic(name) && of.readers > 0; });
    });
    settle(reader_domain_, writer_domain_);
    return made;
  }

  static stream::DenoisedSample denoised(std::int64_t stamp_ns) {
    stream::DenoisedSample sample;
    sample.stamp_ns = stamp_ns;
    return sample;
  }

  std::string prefix_ = "rt/t" + std::to_string(getpid()) + "/";
  Domain reader_domain_ = reader_domain();
  Domain writer_domain_ = writer_domain();
  ImuTopicsHandler handler_;
};

}  // namespace gyrod::bus::test
