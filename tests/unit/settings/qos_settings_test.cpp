#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> messages(const std::string& bus) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings("{\"bus\": " + bus + "}", ".").issues)
    lines.push_back(issue.message);
  return lines;
}

TEST(QosSettings, EveryGroupHasItsOwn) {
  const Outcome outcome = read_settings(R"({"bus": {
      "input": {"reliability": "best_effort", "deadline_s": 0.1, "partitions": ["car*", "lab"]},
      "output": {"liveliness": "manual_by_topic", "liveliness_lease_s": 2, "partitions": ["car7"]},
      "ros2": {"input_reliability": "reliable", "output_deadline_s": 0.5, "partitions": ["car7"]}}})",
                                        ".");
  EXPECT_THAT(outcome.issues, IsEmpty());
  const BusSettings& bus = outcome.settings.bus;
  EXPECT_EQ(bus.input.reliability, InputReliability::kBestEffort);
  EXPECT_EQ(bus.input.qos.deadline_s, 0.1);
  EXPECT_THAT(bus.input.qos.partitions, ElementsAre("car*", "lab"));
  EXPECT_EQ(bus.output.qos.liveliness, Liveliness::kManualByTopic);
  EXPECT_EQ(bus.output.qos.liveliness_lease_s, 2.0);
  EXPECT_EQ(bus.ros2.input_reliability, InputReliability::kReliable);
  EXPECT_EQ(bus.ros2.output_qos.deadline_s, 0.5);
  EXPECT_THAT(bus.ros2.input_qos.partitions, ElementsAre("car7"));
}

TEST(QosSettings, WhereGyrodWritesAPartitionHasNoWildcards) {
  const std::string expected = "; expected a name without '*' and '?', for gyrod writes there";
  EXPECT_THAT(messages(R"({"output": {"partitions": ["car7", "car*"]}, "ros2": {"partitions": ["car?"]}})"),
              ElementsAre("bus.output.partitions[1] is \"car*\"" + expected,
                          "bus.ros2.partitions[0] is \"car?\"" + expected));
}

TEST(QosSettings, LivelinessByTopicNeedsALease) {
  EXPECT_THAT(messages(R"({"input": {"liveliness": "manual_by_topic"}})"),
              ElementsAre("bus.input.liveliness_lease_s is 0.0 (the default); expected above 0, for "
                          "bus.input.liveliness is \"manual_by_topic\""));
}

TEST(QosSettings, SingleTopicsSayWhatDiffersAndNoMore) {
  const Outcome outcome = read_settings(R"({"bus": {
      "ros2": {"topics": ["rt/*/imu_raw"]},
      "topic_qos": [{"topic": "gyro/raw", "reliability": "best_effort", "history_depth": 0},
                    {"topic": "rt/front/imu_raw", "liveliness": "manual_by_topic", "liveliness_lease_s": 0.5,
                     "partitions": ["car*"], "deadline_s": 0.1}]}})",
                                        ".");
  EXPECT_THAT(outcome.issues, IsEmpty());
  const auto& topics = outcome.settings.bus.topic_qos;
  ASSERT_EQ(topics.size(), 2U);
  EXPECT_EQ(topics[0].reliability, InputReliability::kBestEffort);
  EXPECT_EQ(topics[0].history_depth, 0U);
  EXPECT_EQ(topics[0].deadline_s, std::nullopt);
  EXPECT_EQ(topics[1].liveliness, Liveliness::kManualByTopic);
  EXPECT_EQ(topics[1].deadline_s, 0.1);
  EXPECT_THAT(topics[1].partitions.value(), ElementsAre("car*"));
}

TEST(QosSettings, WhatASingleTopicCannotHaveIsRefused) {
  EXPECT_THAT(
      messages(R"({"topic_qos": [{"topic": "gyro/row"}]})"),
      ElementsAre(
          "bus.topic_qos[0] is \"gyro/row\"; expected one of bus.topics, a topic of bus.ros2.topics or an "
          "output of one, or a pattern as there"));
  EXPECT_THAT(messages(R"({"topic_qos": [{"topic": "rt/imu"}]})"), ::testing::SizeIs(1)) << "read by nobody";
  EXPECT_THAT(
      messages(R"({"topic_qos": [{"topic": "gyro/noise", "reliability": "auto"}]})"),
      ElementsAre("bus.topic_qos[0] is \"auto\"; expected \"reliable\" or \"best_effort\", for gyrod writes "
                  "gyro/noise"));
  EXPECT_THAT(messages(R"({"topic_qos": [{"topic": "gyro/noise", "history_depth": 0}]})"),
              ::testing::SizeIs(1));
  EXPECT_THAT(
      messages(R"({"topic_qos": [{"topic": "gyro/raw", "liveliness": "manual_by_topic"}]})"),
      ElementsAre("bus.topic_qos[0] is \"manual_by_topic\"; expected a liveliness_lease_s above 0 with it"));
  EXPECT_THAT(
      messages(R"({"topic_qos": [{"topic": "gyro/denoised", "partitions": ["car*"]}]})"),
      ElementsAre(
          "bus.topic_qos[0].partitions[0] is \"car*\"; expected a name without '*' and '?', for gyrod writes "
          "there"));
  EXPECT_THAT(messages(R"({"topic_qos": [{"topic": "gyro/raw", "depth": 3}]})"),
              ElementsAre(::testing::HasSubstr("depth")));
  EXPECT_THAT(messages(R"({"topic_qos": [{"deadline_s": 3}]})"), ElementsAre(::testing::HasSubstr("topic")));
}

}  // namespace
}  // namespace gyrod::settings
