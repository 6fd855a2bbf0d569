/// A ROS 2 driver that sends while a test goes on, and what its subscribers are to get.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/imu_node.hpp"

namespace gyrod::testing {

/// Publishes on a thread of its own, at 200 Hz, until it is stopped.
class ImuDriver {
 public:
  ImuDriver(dds_entity_t participant, const std::string& topic, std::vector<ImuMessage> messages)
      : messages_(std::move(messages)), publisher_(participant, topic) {}
  ~ImuDriver() { stop(); }
  ImuDriver(const ImuDriver&) = delete;
  ImuDriver& operator=(const ImuDriver&) = delete;

  void start() {
    thread_ = std::thread([this] {
      constexpr std::chrono::milliseconds kPeriod{5};
      for (auto due = std::chrono::steady_clock::now(); !stopping_ && sent_ < messages_.size();
           due += kPeriod) {
        std::this_thread::sleep_until(due);
        publisher_.publish(messages_[sent_++]);
      }
    });
  }
  /// @return what was published
  std::vector<ImuMessage> stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    return {messages_.begin(), messages_.begin() + static_cast<std::ptrdiff_t>(sent_.load())};
  }

 private:
  std::vector<ImuMessage> messages_;
  ImuPublisher publisher_;
  std::atomic<std::size_t> sent_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// All that was sent has come, in order, and nothing but rates has changed. @return messages that came once more
inline std::size_t expect_all(const std::vector<ImuMessage>& came, const std::vector<ImuMessage>& sent) {
  std::size_t next = 0;
  std::size_t again = 0;
  for (const ImuMessage& message : came) {
    if (next > 0 && stamp_ns_of(message) <= stamp_ns_of(sent[next - 1])) {
      ++again;
    } else if (next < sent.size() && untouched_bits(message) == untouched_bits(sent[next])) {
      ++next;
    } else {
      ADD_FAILURE() << "message " << next << " of " << sent.size() << " is missing";
      return again;
    }
  }
  EXPECT_EQ(next, sent.size());
  return again;
}

}  // namespace gyrod::testing
