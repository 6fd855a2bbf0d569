// What differs for single topics.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/bus_options.hpp"

namespace gyrod::bus {
namespace {

using ::testing::ElementsAre;

TEST(TopicQosTest, WhatIsSaidOfATopicTakesThePlaceOfItsGroupsAndTheRestStays) {
  BusOptions options;
  options.input.partitions = {"car7"};
  options.input.lease_s = 3.0;
  options.topic_qos = {
      {.topic = "gyro/raw", .reliability = InputReliability::kBestEffort, .depth = 7, .deadline_s = 0.1}};
  const BusOptions raw = for_topic(options, "gyro/raw");
  EXPECT_EQ(raw.input_reliability, InputReliability::kBestEffort);
  EXPECT_EQ(raw.input_history, History::kKeepLast);
  EXPECT_EQ(raw.input_depth, 7U);
  EXPECT_EQ(raw.input.deadline_s, 0.1);
  EXPECT_EQ(raw.input.lease_s, 3.0);
  EXPECT_THAT(raw.input.partitions, ElementsAre("car7"));
  const BusOptions batch = for_topic(options, "gyro/raw_batch");
  EXPECT_EQ(batch.input_reliability, InputReliability::kAuto);
  EXPECT_EQ(batch.input.deadline_s, 0.0);
}

TEST(TopicQosTest, APatternIsOfRos2TopicsAndTheLastThatSaysSomethingHolds) {
  BusOptions options;
  options.topic_qos = {{.topic = "rt/*/imu_raw", .depth = 5, .deadline_s = 0.5},
                       {.topic = "rt/front/imu_raw", .deadline_s = 0.2}};
  EXPECT_EQ(for_topic(options, "rt/rear/imu_raw").ros2.input.deadline_s, 0.5);
  const Ros2Options front = for_topic(options, "rt/front/imu_raw").ros2;
  EXPECT_EQ(front.input.deadline_s, 0.2);
  EXPECT_EQ(front.depth, 5U);
  EXPECT_EQ(for_topic(options, "rt/front/imu_denoised").ros2.depth, Ros2Options{}.depth);
}

TEST(TopicQosTest, AnOutputIsReliableOrNotButNeverAuto) {
  BusOptions options;
  options.topic_qos = {{.topic = "gyro/denoised", .reliability = InputReliability::kBestEffort},
                       {.topic = "gyro/realtime", .reliability = InputReliability::kAuto}};
  EXPECT_EQ(for_topic(options, "gyro/denoised").output_reliability, Reliability::kBestEffort);
  EXPECT_EQ(for_topic(options, "gyro/realtime").output_reliability, Reliability::kReliable);
}

TEST(TopicQosTest, ReportsPromiseNothingOfWhatTheSamplesDoUnlessItIsSaidOfThem) {
  BusOptions options;
  options.output = {.deadline_s = 1.0, .partitions = {"car7"}};
  options.topic_qos = {{.topic = "gyro/health", .lease_s = 2.0}};
  EXPECT_EQ(for_topic(options, "gyro/noise").output.deadline_s, 0.0);
  EXPECT_THAT(for_topic(options, "gyro/noise").output.partitions, ElementsAre("car7"));
  EXPECT_EQ(for_topic(options, "gyro/health").output.lease_s, 2.0);
}

}  // namespace
}  // namespace gyrod::bus
