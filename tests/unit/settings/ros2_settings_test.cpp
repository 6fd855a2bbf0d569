#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> messages(const std::string& ros2) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings(R"({"bus": {"ros2": )" + ros2 + "}}", ".").issues)
    lines.push_back(issue.message);
  return lines;
}

TEST(Ros2Settings, TopicsAndPatternsAreTaken) {
  const Outcome outcome =
      read_settings(R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw", "rt/*/imu/data_raw"]}}})", ".");
  EXPECT_THAT(outcome.issues, IsEmpty());
  EXPECT_THAT(outcome.settings.bus.ros2.topics, ElementsAre("rt/imu/data_raw", "rt/*/imu/data_raw"));
}

TEST(Ros2Settings, EveryWrongTopicIsNamedWithItsPlace) {
  const std::string expected =
      "; expected rt/ and then names of letters, digits and single '_', with '/' between them and '*' for "
      "parts of them";
  EXPECT_THAT(messages(R"({"topics": ["/imu/data_raw", "rt/imu", "rt/**/imu"]})"),
              ElementsAre("bus.ros2.topics[0] is \"/imu/data_raw\"" + expected,
                          "bus.ros2.topics[2] is \"rt/**/imu\"" + expected));
}

TEST(Ros2Settings, WhatIsWrongInsideTheListIsSaidOfTheList) {
  const std::string expected = "; expected a list of at most 1024, each a text of 4 to 64 characters";
  EXPECT_THAT(messages(R"({"topics": "rt/imu"})"), ElementsAre("bus.ros2.topics is \"rt/imu\"" + expected));
  EXPECT_THAT(messages(R"({"topics": ["rt/imu", 7]})"),
              ElementsAre("bus.ros2.topics is [\"rt/imu\",7]" + expected));
  EXPECT_THAT(messages(R"({"topics": [["rt/imu"]]})"),
              ElementsAre("bus.ros2.topics is [[\"rt/imu\"]]" + expected));
  const std::string too_long = "rt/" + std::string(62, 'a');  // a sensor id has 64 characters at the most
  EXPECT_THAT(messages("{\"topics\": [\"" + too_long + "\"]}"),
              ElementsAre("bus.ros2.topics is [\"" + too_long + "\"]" + expected));
}

TEST(Ros2Settings, NoInputIsAnOutput) {
  EXPECT_THAT(
      messages(R"({"topics": ["rt/imu/data_denoised"]})"),
      ElementsAre(
          "bus.ros2.topics[0] is \"rt/imu/data_denoised\"; expected a topic that does not end as gyrod's own "
          "output does"));
  EXPECT_THAT(messages(R"({"topics": ["rt/imu_out"], "realtime_suffix": "_out"})").size(), 1U);
}

TEST(Ros2Settings, NoTwoTopicsHaveTheSameOutput) {
  EXPECT_THAT(
      messages(R"({"topics": ["rt/imu_raw", "rt/imu"]})"),
      ElementsAre("bus.ros2.topics[1] is \"rt/imu\"; expected a topic with outputs of its own, not those of "
                  "\"rt/imu_raw\""));
  EXPECT_THAT(messages(R"({"topics": ["rt/imu", "rt/imu"]})").size(), 1U);
}

TEST(Ros2Settings, SuffixesMakeRos2NamesAndDiffer) {
  const std::string expected =
      "; expected letters, digits, single '_' and '/' that can end a topic's name, and another end than _raw";
  EXPECT_THAT(messages(R"({"denoised_suffix": "/"})"),
              ElementsAre("bus.ros2.denoised_suffix is \"/\"" + expected));
  EXPECT_THAT(messages(R"({"realtime_suffix": "_raw"})"),
              ElementsAre("bus.ros2.realtime_suffix is \"_raw\"" + expected));
  EXPECT_THAT(
      messages(R"({"realtime_suffix": "_denoised"})"),
      ElementsAre(
          "bus.ros2.realtime_suffix is \"_denoised\"; expected another one than bus.ros2.denoised_suffix"));
}

}  // namespace
}  // namespace gyrod::settings
