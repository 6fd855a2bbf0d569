// Two daemons with the same ROS 2 outputs, as two processes, and what a subscription gets when one of them goes.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "standby_pair.hpp"
#include "support/eventually.hpp"
#include "support/imu_node.hpp"

namespace gyrod::testing {
namespace {

using Clock = std::chrono::steady_clock;

/// A driver that publishes on a thread of its own, at 200 Hz, until it is stopped.
class Driver {
 public:
  Driver(dds_entity_t participant, const std::string& topic, std::vector<ImuMessage> messages)
      : messages_(std::move(messages)), publisher_(participant, topic) {}
  ~Driver() { stop(); }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  void start() {
    thread_ = std::thread([this] {
      constexpr std::chrono::milliseconds kPeriod{5};
      for (auto due = Clock::now(); !stopping_ && sent_ < messages_.size(); due += kPeriod) {
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
  [[nodiscard]] std::size_t sent() const { return sent_; }

 private:
  std::vector<ImuMessage> messages_;
  ImuPublisher publisher_;
  std::atomic<std::size_t> sent_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

class Ros2Standby : public StandbyPair {
 protected:
  static constexpr std::size_t kLag = 16;

  void SetUp() override {
    takeover_s_ = 1.0;  // longer than a busy machine keeps a daemon waiting
    options_.patch = R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw"]}}})";
    start_two();
    ASSERT_TRUE(
        eventually([&] { return denoised_.matched_writers() == 2 && realtime_.matched_writers() == 2; }));
    ASSERT_TRUE(eventually([&] { return have_the_driver(); }));
    driver_.start();
    ASSERT_TRUE(more_come(300));
    ASSERT_TRUE(eventually([&] { return is_on(*first_) && !is_on(*second_); }));
  }

  [[nodiscard]] bool have_the_driver() const {
    return of(*first_, "gyrod_bus_matched_writers") == 1.0 &&
           of(*second_, "gyrod_bus_matched_writers") == 1.0;
  }
  [[nodiscard]] static bool is_on(const Process& daemon) { return publishes(daemon, 1.0); }
  [[nodiscard]] bool more_come(std::size_t messages) {
    const std::size_t from = denoised_.messages().size();
    return denoised_.wait_for(from + messages) && realtime_.wait_for(from + messages);
  }

  /// All that was sent has come, in order, but for the last ones that wait for their look-ahead; nothing but rates has changed. Twice came
  /// no more than so many of an output.
  void expect_seamless(std::size_t twice) {
    const std::vector<ImuMessage> sent = driver_.stop();
    ASSERT_TRUE(eventually([&] {
      return stamp_ns_of(realtime_.messages().back()) == stamp_ns_of(sent.back()) &&
             stamp_ns_of(denoised_.messages().back()) == stamp_ns_of(sent[sent.size() - 1 - kLag]);
    }));
    expect_all(denoised_.messages(), {sent.begin(), sent.end() - kLag}, twice);
    expect_all(realtime_.messages(), sent, twice);
  }

 private:
  static void expect_all(const std::vector<ImuMessage>& came, const std::vector<ImuMessage>& sent,
                         std::size_t twice) {
    std::size_t next = 0;
    std::size_t again = 0;
    for (const ImuMessage& message : came) {
      if (next > 0 && stamp_ns_of(message) <= stamp_ns_of(sent[next - 1])) {
        ++again;
        continue;
      }
      ASSERT_LT(next, sent.size());
      ASSERT_TRUE(untouched_bits(message) == untouched_bits(sent[next]))
          << "message " << next << " is missing";
      ++next;
    }
    EXPECT_EQ(next, sent.size());
    EXPECT_LE(again, twice);
    RecordProperty("twice", static_cast<int>(again));
  }

  bus::Domain domain_{domain_id(), "loopback"};
  ImuSubscription denoised_{domain_.participant(), "rt/imu/data_denoised"};
  ImuSubscription realtime_{domain_.participant(), "rt/imu/data_realtime"};

 protected:
  Driver driver_{domain_.participant(), "rt/imu/data_raw", noisy_imu_messages(20'000)};
};

TEST_F(Ros2Standby, GoesOnWithTheMessageThatWouldHaveComeNextWhenTheOtherIsKilled) {
  first_->signal(SIGKILL);
  ASSERT_TRUE(eventually([&] { return is_on(*second_); }));
  ASSERT_TRUE(more_come(200));
  expect_seamless(4);
  EXPECT_EQ(of(*second_, "gyrod_standby_takeovers_total"), 1.0);
  EXPECT_EQ(of(*second_, "gyrod_ros2_dropped_messages_total"), 0.0);
  EXPECT_EQ(stop_daemon(*second_), 0);
}

TEST_F(Ros2Standby, WhoTookOverGoesOnWhenTheOtherIsBackUntilItLeavesItself) {
  first_->signal(SIGTERM);
  ASSERT_EQ(first_->wait(), 0) << first_->err();
  ASSERT_TRUE(eventually([&] { return is_on(*second_); }));
  first_ = start_one(kFirst);
  ASSERT_TRUE(eventually(
      [&] { return have_the_driver() && of(*first_, "gyrod_standby_samples_let_go_total") > 100.0; }));
  EXPECT_FALSE(is_on(*first_));
  ASSERT_TRUE(more_come(200));
  EXPECT_TRUE(is_on(*second_));
  second_->signal(SIGTERM);
  ASSERT_EQ(second_->wait(), 0) << second_->err();
  ASSERT_TRUE(more_come(200));
  EXPECT_TRUE(is_on(*first_));
  expect_seamless(8);
  EXPECT_EQ(stop_daemon(*first_), 0);
}

TEST_F(Ros2Standby, StandsInForOneThatIsStoppedForAWhile) {
  first_->signal(SIGSTOP);
  ASSERT_TRUE(eventually([&] { return is_on(*second_); }));
  ASSERT_TRUE(more_come(200));
  first_->signal(SIGCONT);
  ASSERT_TRUE(more_come(400));
  EXPECT_TRUE(is_on(*first_) != is_on(*second_)) << "one of them";
  expect_seamless(8);
  for (const auto* daemon : {&first_, &second_}) EXPECT_EQ(stop_daemon(**daemon), 0) << (*daemon)->err();
}

}  // namespace
}  // namespace gyrod::testing
