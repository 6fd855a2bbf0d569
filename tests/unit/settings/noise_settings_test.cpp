#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"
#include "settings/noise_calibration.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> messages(const std::string& text, const std::filesystem::path& folder) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings(text, folder).issues) lines.push_back(issue.message);
  return lines;
}

std::string a_calibration() {
  NoiseCalibration calibration;
  calibration.sample_rate_hz = 100.0;
  calibration.models.fill(core::white_noise(1e-5));
  calibration.origin.source = "a test";
  return calibration_text(calibration);
}

TEST(NoiseSettings, PathsAreRelativeToTheConfiguration) {
  const testing::ScratchFolder folder;
  folder.write("cal.json", a_calibration());
  folder.write("gyrod.json", R"({"noise": {"calibrations": "cal.json", "state_file": "state/noise.json"}})");
  const Settings settings = load_settings(folder.path("gyrod.json"));
  EXPECT_EQ(settings.noise.calibrations, folder.path("cal.json"));
  EXPECT_EQ(settings.noise.state_file, folder.path("state/noise.json"));
  EXPECT_EQ(read_settings("{}", ".").settings.noise.state_file, "") << "none stays none";
}

TEST(NoiseSettings, CalibratedNeedsACalibration) {
  const testing::ScratchFolder folder;
  EXPECT_THAT(
      messages(R"({"noise": {"source": "calibrated"}})", folder.path()),
      ElementsAre("noise.calibrations is \"\" (the default); expected a file or folder, for noise.source is "
                  "\"calibrated\""));
  folder.write("cal.json", a_calibration());
  EXPECT_THAT(messages(R"({"noise": {"source": "calibrated", "calibrations": "cal.json"}})", folder.path()),
              IsEmpty());
}

TEST(NoiseSettings, ACalibrationThatCannotBeReadIsAnErrorOfTheConfiguration) {
  const testing::ScratchFolder folder;
  folder.write("cal.json", "{}");
  EXPECT_THAT(messages(R"({"noise": {"calibrations": "cal.json"}})", folder.path()),
              ElementsAre("noise.calibrations: " + folder.path("cal.json") +
                          ": gyrod_noise is missing; expected 1, the version that this gyrod knows"));
  EXPECT_THAT(messages(R"({"noise": {"calibrations": "none"}})", folder.path()),
              ElementsAre(HasSubstr("/none: no such file")));
}

TEST(NoiseSettings, TheStateIsAFileOfItsOwn) {
  const testing::ScratchFolder folder;
  folder.write("cal.json", a_calibration());
  EXPECT_THAT(messages(R"({"noise": {"state_file": "."}})", folder.path()),
              ElementsAre("noise.state_file is \".\"; expected a file, not a folder"));
  EXPECT_THAT(messages(R"({"noise": {"calibrations": "cal.json", "state_file": "cal.json"}})", folder.path()),
              ElementsAre("noise.state_file is \"cal.json\"; expected another file than noise.calibrations"));
}

TEST(RestartSettings, WhatWasPublishedIsKeptInAFileOfItsOwnNamedFromTheConfigurationOn) {
  const testing::ScratchFolder folder;
  EXPECT_THAT(messages(R"({"restart": {"published_file": "."}})", folder.path()),
              ElementsAre("restart.published_file is \".\"; expected a file, not a folder"));
  EXPECT_THAT(
      messages(R"({"noise": {"state_file": "state"}, "restart": {"published_file": "state"}})",
               folder.path()),
      ElementsAre("restart.published_file is \"state\"; expected another file than noise.state_file"));
  const Outcome outcome = read_settings(R"({"restart": {"published_file": "published"}})", folder.path());
  EXPECT_EQ(outcome.settings.restart.published_file, folder.path("published"));
  EXPECT_EQ(read_settings("{}", ".").settings.restart.published_file, "") << "none stays none";
}

}  // namespace
}  // namespace gyrod::settings
