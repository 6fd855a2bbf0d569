#include "settings/unused_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> unused(std::string_view text) {
  const Outcome outcome = read_settings(text, "/");
  EXPECT_THAT(outcome.issues, IsEmpty());
  return unused_keys(outcome.settings);
}

TEST(UnusedKeys, TheDefaultsAskForNothingInVain) {
  EXPECT_THAT(unused("{}"), IsEmpty());
  EXPECT_THAT(unused(R"({"denoise": {"method": "paper"}})"), IsEmpty());
}

TEST(UnusedKeys, AKeyOfTheOtherMethodIsNamedWithItsValueAndBothMethods) {
  EXPECT_THAT(
      unused(R"({"denoise": {"scheme": "emd", "max_ar_order": 3}})"),
      ElementsAre(R"(denoise.scheme is "emd", which is for denoise.method "paper"; it is "joint")",
                  R"(denoise.max_ar_order is 3, which is for denoise.method "paper"; it is "joint")"));
  EXPECT_THAT(
      unused(R"({"denoise": {"method": "paper", "max_signal_hz": 5}})"),
      ElementsAre(R"(denoise.max_signal_hz is 5.0, which is for denoise.method "joint"; it is "paper")"));
}

TEST(UnusedKeys, WindowsThatAreNotToFollowTheRateAreOfMethodJoint) {
  EXPECT_THAT(
      unused(R"({"denoise": {"method": "paper", "stretch_windows": false}})"),
      ElementsAre(R"(denoise.stretch_windows is false, which is for denoise.method "joint"; it is "paper")"));
  EXPECT_THAT(unused(R"({"denoise": {"stretch_windows": false}})"), IsEmpty());
}

TEST(UnusedKeys, ASignalBandThatReachesHalfTheSampleRateIs) {
  EXPECT_THAT(
      unused(R"({"denoise": {"max_signal_hz": 60, "sample_rate_hz": 100}})"),
      ElementsAre("denoise.max_signal_hz is 60; at a sample rate of 100 Hz there is nothing above 50 Hz"));
  EXPECT_THAT(unused(R"({"denoise": {"max_signal_hz": 49.9, "sample_rate_hz": 100}})"), IsEmpty());
  EXPECT_THAT(unused(R"({"denoise": {"max_signal_hz": 60}})"), IsEmpty()) << "the rate is not known";
  EXPECT_EQ(unused_band(60.0, 0.0), "");
  EXPECT_EQ(unused_band(0.0, 100.0), "");
  EXPECT_NE(unused_band(50.0, 100.0), "");
}

TEST(UnusedKeys, AKeyOfTheMethodInUseAndAKeyAtItsDefaultAreNot) {
  EXPECT_THAT(unused(R"({"denoise": {"method": "paper", "scheme": "emd", "screening": "paper"}})"),
              IsEmpty());
  EXPECT_THAT(unused(R"({"denoise": {"max_signal_hz": 5}, "bus": {"topics": {"realtime": "now"}}})"),
              IsEmpty());
  EXPECT_THAT(unused(R"({"denoise": {"scheme": "improved", "sifts": 10, "boundary": "mirror"}})"), IsEmpty());
}

}  // namespace
}  // namespace gyrod::settings
