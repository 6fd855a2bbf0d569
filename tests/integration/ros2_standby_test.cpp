// Two daemons with the same ROS 2 outputs, as two processes, and what a subscription gets when one of them goes.
#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "standby_pair.hpp"
#include "support/eventually.hpp"
#include "support/imu_driver.hpp"

namespace gyrod::testing {
namespace {

class Ros2Standby : public StandbyPair {
 protected:
  static constexpr std::size_t kLag = 16;

  void SetUp() override {
    takeover_s_ = 1.0;  // longer than a busy machine keeps a daemon waiting
    options_.patch = R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw"]}}})";
    start_two();
    ASSERT_TRUE(
        eventually([&] { return denoised_.matched_writers() == 2 && realtime_.matched_writers() == 2; }));
    for (const auto* daemon : {&first_, &second_}) {
      ASSERT_TRUE(eventually([&] {
        return has_reader(**daemon, "rt/imu/data_denoised") && has_reader(**daemon, "rt/imu/data_realtime");
      }));
    }
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
    for (const std::size_t again : {expect_all(denoised_.messages(), {sent.begin(), sent.end() - kLag}),
                                    expect_all(realtime_.messages(), sent)}) {
      EXPECT_LE(again, twice);
      RecordProperty("twice", static_cast<int>(again));
    }
  }

 private:
  bus::Domain domain_{domain_id(), "loopback"};
  ImuSubscription denoised_{domain_.participant(), "rt/imu/data_denoised"};
  ImuSubscription realtime_{domain_.participant(), "rt/imu/data_realtime"};

 protected:
  ImuDriver driver_{domain_.participant(), "rt/imu/data_raw", noisy_imu_messages(20'000)};
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
