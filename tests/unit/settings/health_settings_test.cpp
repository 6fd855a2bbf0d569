#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> messages(const std::string& health) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings("{\"health\": " + health + "}", ".").issues)
    lines.push_back(issue.message);
  return lines;
}

TEST(HealthSettings, AllAxesAreStuckNoSoonerThanOne) {
  EXPECT_THAT(messages(R"({"stuck_after_s": 10})"), IsEmpty()) << "as long as all_stuck_after_s is by itself";
  EXPECT_THAT(messages(R"({"stuck_after_s": 3, "all_stuck_after_s": 3})"), IsEmpty());
  EXPECT_THAT(messages(R"({"stuck_after_s": 3, "all_stuck_after_s": 2.5})"),
              ElementsAre("health.all_stuck_after_s is 2.5; expected at least health.stuck_after_s (3)"));
  EXPECT_THAT(
      messages(R"({"stuck_after_s": 10.5})"),
      ElementsAre(
          "health.all_stuck_after_s is 10.0 (the default); expected at least health.stuck_after_s (10.5)"));
}

TEST(HealthSettings, NoisyIsLeftBelowWhereItIsEntered) {
  EXPECT_THAT(messages(R"({"noisy_ratio": 1.3})"), IsEmpty());
  EXPECT_THAT(messages(R"({"noisy_clear_ratio": 1.51})"),
              ElementsAre("health.noisy_clear_ratio is 1.51; expected at most health.noisy_ratio (1.5)"));
  EXPECT_THAT(
      messages(R"({"noisy_ratio": 1.2})"),
      ElementsAre(
          "health.noisy_clear_ratio is 1.3 (the default); expected at most health.noisy_ratio (1.2)"));
}

TEST(HealthSettings, LossyIsLeftBelowWhereItIsEntered) {
  EXPECT_THAT(messages(R"({"lossy_share": 0.005})"), IsEmpty());
  EXPECT_THAT(messages(R"({"lossy_clear_share": 0.02})"),
              ElementsAre("health.lossy_clear_share is 0.02; expected at most health.lossy_share (0.01)"));
  EXPECT_THAT(
      messages(R"({"lossy_share": 0.001})"),
      ElementsAre(
          "health.lossy_clear_share is 0.005 (the default); expected at most health.lossy_share (0.001)"));
}

TEST(HealthSettings, EveryRuleThatIsBrokenIsNamed) {
  EXPECT_THAT(messages(R"({"all_stuck_after_s": 0.5, "noisy_clear_ratio": 2, "lossy_clear_share": 1})"),
              ElementsAre("health.all_stuck_after_s is 0.5; expected at least health.stuck_after_s (1)",
                          "health.noisy_clear_ratio is 2.0; expected at most health.noisy_ratio (1.5)",
                          "health.lossy_clear_share is 1.0; expected at most health.lossy_share (0.01)"));
}

TEST(HealthSettings, ARuleAboutAValueThatIsNoneIsLeftOut) {
  EXPECT_THAT(messages(R"({"noisy_ratio": 0.5, "noisy_clear_ratio": 2})"),
              ElementsAre("health.noisy_ratio is 0.5; expected a number from 1 to 1000"));
  EXPECT_THAT(messages(R"({"stuck_after_s": 5, "all_stuck_after_s": 0})"),
              ElementsAre("health.all_stuck_after_s is 0; expected a number from 0.01 to 86400 (s)"));
}

}  // namespace
}  // namespace gyrod::settings
