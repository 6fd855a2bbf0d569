// Names by the rules of ROS 2 (design article "Topic and Service name mapping to DDS") and of docs/ros2.md.
#include "ros2/names.hpp"

#include <gtest/gtest.h>

namespace gyrod::ros2 {
namespace {

TEST(Ros2Names, ATopicBeginsWithRtAndIsMadeOfNames) {
  for (const char* topic : {"rt/imu", "rt/imu/data_raw", "rt/_a/B9", "rt/x/y/z"})
    EXPECT_TRUE(is_topic(topic)) << topic;
  for (const char* text : {"", "rt", "rt/", "imu/data_raw", "/imu", "rt//imu", "rt/imu/", "rt/9imu", "rt/a b",
                           "rt/a-b", "rt/a__b", "rt/*/imu", "rq/imu"}) {
    EXPECT_FALSE(is_topic(text)) << text;
  }
}

TEST(Ros2Names, APatternIsATopicWithStarsForPartsOfNames) {
  for (const char* text : {"rt/*", "rt/*/imu/data_raw", "rt/car_*/imu", "rt/*_raw", "rt/imu"}) {
    EXPECT_TRUE(is_topic_or_pattern(text)) << text;
  }
  for (const char* text : {"*", "*/imu", "rt/**", "rt/[ab]", "rt/?", "rt/*/", "rt/9*"}) {
    EXPECT_FALSE(is_topic_or_pattern(text)) << text;
  }
  EXPECT_TRUE(is_pattern("rt/*"));
  EXPECT_FALSE(is_pattern("rt/imu"));
}

TEST(Ros2Names, AStarIsOneOrMoreCharactersOfOneName) {
  EXPECT_TRUE(matches("rt/*/imu/data_raw", "rt/car/imu/data_raw"));
  EXPECT_TRUE(matches("rt/*/imu/data_raw", "rt/x/imu/data_raw"));
  EXPECT_FALSE(matches("rt/*/imu/data_raw", "rt/imu/data_raw")) << "not none";
  EXPECT_FALSE(matches("rt/*/imu/data_raw", "rt/a/b/imu/data_raw")) << "not two names";
  EXPECT_FALSE(matches("rt/*/imu/data_raw", "rt/car/imu/data"));
  EXPECT_FALSE(matches("rt/*/imu/data", "rt/car/imu/data_raw")) << "the whole name, not its beginning";
  EXPECT_TRUE(matches("rt/imu_*_raw", "rt/imu_a_raw_raw"))
      << "the star takes more where the rest asks for it";
  EXPECT_FALSE(matches("rt/imu_*_raw", "rt/imu__raw"));
  EXPECT_TRUE(matches("rt/*a*b", "rt/xaxab"));
  EXPECT_FALSE(matches("rt/*a*b", "rt/xb"));
  EXPECT_TRUE(matches("rt/*/*", "rt/a/b"));
  EXPECT_FALSE(matches("rt/*", "rt/a/b"));
  EXPECT_FALSE(matches("rt/*", "rt/"));
  EXPECT_TRUE(matches("rt/imu", "rt/imu"));
  EXPECT_FALSE(matches("rt/imu", "rt/imu2"));
}

TEST(Ros2Names, OutputsTakeThePlaceOfRawOrStandBehindTheName) {
  const Outputs of_raw = outputs_of("rt/car/imu/data_raw", {});
  EXPECT_EQ(of_raw.denoised, "rt/car/imu/data_denoised");
  EXPECT_EQ(of_raw.realtime, "rt/car/imu/data_realtime");
  EXPECT_EQ(outputs_of("rt/imu", {}).denoised, "rt/imu_denoised");
  EXPECT_EQ(outputs_of("rt/imu_raw", {"/denoised", "/realtime"}).realtime, "rt/imu/realtime");
}

TEST(Ros2Names, AnOutputIsKnownByItsEnd) {
  EXPECT_TRUE(is_output("rt/car/imu/data_denoised", {}));
  EXPECT_TRUE(is_output("rt/car/imu/data_realtime", {}));
  EXPECT_TRUE(is_output("rt/*_realtime", {})) << "whatever the pattern stands for";
  EXPECT_FALSE(is_output("rt/car/imu/data_raw", {}));
  EXPECT_FALSE(is_output("rt/car_denoised/imu", {}));
}

TEST(Ros2Names, ASuffixMakesATopicThatIsNoInputAgain) {
  for (const char* text : {"_denoised", "/denoised", "2", "_a/b"}) EXPECT_TRUE(is_suffix(text)) << text;
  for (const char* text : {"", "/", "__a", "_raw", "_x_raw", "_a/", " ", "*", "/9"})
    EXPECT_FALSE(is_suffix(text)) << text;
}

}  // namespace
}  // namespace gyrod::ros2
