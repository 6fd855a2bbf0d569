// What an evaluation is told of the noise: by noise.source, a calibration, the spare samples and rest.
#include "app/evaluation_noise.hpp"

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/angle_units.hpp"
#include "app/evaluation_rows.hpp"
#include "core/noise/still_noise.hpp"
#include "settings/json_fields.hpp"
#include "support/scratch_folder.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;
using app::NoiseKnownBy;
using settings::NoiseSource;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

class EvaluationNoiseTest : public ::testing::Test {
 protected:
  /// White noise at 100 Hz; of x `std_dps`, of z three times that, none of y.
  [[nodiscard]] std::string calibration(const std::string& name, const std::string& sensor = "",
                                        double std_dps = 0.2) const {
    settings::NoiseCalibration calibration;
    if (!sensor.empty()) calibration.sensor_id = sensor;
    calibration.sample_rate_hz = 100.0;
    for (const std::size_t axis : {0U, 2U}) {
      const double level = (axis == 0 ? 1.0 : 3.0) * std_dps * app::kRadPerDeg;
      calibration.models[axis] = core::white_noise(level * level);
    }
    folder_.write(name, settings::calibration_text(calibration));
    return folder_.path(name);
  }
  static app::NoiseKnowledge known(const std::string& calibration, const std::string& sensor = "",
                                   NoiseSource source = NoiseSource::kAuto,
                                   const std::string& configured = "") {
    settings::NoiseSettings settings;
    settings.source = source;
    settings.calibrations = configured;
    return app::noise_knowledge(calibration, sensor, settings);
  }
  /// Standard deviation, deg/s, less the margin; 0 where nothing is known.
  static double level(const app::RowNoise& noise) {
    if (noise.course.empty()) return 0.0;
    return std::sqrt(core::noise_variance(noise.course.front().model)) / core::kNoiseMargin;
  }

  ScratchFolder folder_;
  Signal spare_ = white_noise(4000, 5);  ///< 1 deg/s
};

TEST_F(EvaluationNoiseTest, IsWhatTheCommandLineNamesWhateverTheSource) {
  const std::string file = calibration("front.json", "front");
  for (const NoiseSource source :
       {NoiseSource::kAuto, NoiseSource::kImf1, NoiseSource::kStandstill, NoiseSource::kCalibrated}) {
    const auto noise = app::told_beforehand(known(file, "", source), "x", {spare_}, 1.0, 100.0);
    EXPECT_EQ(noise.by, NoiseKnownBy::kCalibration);
    EXPECT_EQ(noise.from_sample, 0U);
    EXPECT_FALSE(noise.learns);
    EXPECT_NEAR(level(noise), 0.2, 1e-12);
  }
}

TEST_F(EvaluationNoiseTest, IsAsStrongAsTheSensorsIsMadeAndOfTheAxisThatIsAdded) {
  const auto file = known(calibration("all.json"));
  EXPECT_NEAR(level(app::told_beforehand(file, "x", {}, 3.0, 100.0)), 0.6, 1e-12);
  EXPECT_NEAR(level(app::told_beforehand(file, "-z", {}, 1.0, 100.0)), 0.6, 1e-12);
}

// The density holds: twice the rate, sqrt(2) the standard deviation. y has the strongest of the others.
TEST_F(EvaluationNoiseTest, SaysWhatACalibrationLacksAndDoesAsTheDaemonDoes) {
  const auto file = known(calibration("all.json"));
  EXPECT_NEAR(level(app::told_beforehand(file, "x", {}, 1.0, 200.0)), 0.2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(level(app::told_beforehand(file, "y", {}, 1.0, 100.0)), 0.6, 1e-12);
  EXPECT_THAT(app::calibration_cautions(file, {"x", "-z"}, 101.0), IsEmpty());
  EXPECT_THAT(
      app::calibration_cautions(file, {"x", "y"}, 200.0),
      ElementsAre(AllOf(HasSubstr("all.json"), HasSubstr("100.0 Hz; at 200.0 Hz only its mean density")),
                  AllOf(HasSubstr("all.json"), HasSubstr("has no axis y"))));
}

TEST_F(EvaluationNoiseTest, IsOfTheSensorThatIsNamed) {
  static_cast<void>(calibration("front.json", "front", 0.1));
  static_cast<void>(calibration("rear.json", "rear", 0.2));
  const auto rear = known(folder_.path(""), "rear");
  EXPECT_NEAR(level(app::told_beforehand(rear, "x", {}, 1.0, 100.0)), 0.2, 1e-12);
  EXPECT_THAT([&] { static_cast<void>(known(folder_.path(""), "top")); },
              ThrowsMessage<CLI::ValidationError>(
                  AllOf(HasSubstr("--calibration"), HasSubstr("no calibration for sensor 'top'"))));
  folder_.write("bad.json", R"({"gyrod_noise": 1, "sample_rate_hz": -1})");
  EXPECT_THAT([&] { static_cast<void>(known(folder_.path("bad.json"))); },
              ThrowsMessage<settings::NoiseFileError>(HasSubstr("bad.json")));
}

TEST_F(EvaluationNoiseTest, IsThatOfTheConfigurationWhereItsSourceAndSensorAllow) {
  const std::string file = calibration("front.json", "front");
  EXPECT_TRUE(known("", "front", NoiseSource::kAuto, file).calibration);
  EXPECT_TRUE(known("", "front", NoiseSource::kCalibrated, file).calibration);
  EXPECT_FALSE(known("", "front", NoiseSource::kStandstill, file).calibration);
  EXPECT_FALSE(known("", "front", NoiseSource::kImf1, file).calibration);
  EXPECT_FALSE(known("", "rear", NoiseSource::kAuto, file).calibration);
  EXPECT_FALSE(known("", "", NoiseSource::kAuto, file).calibration);
  EXPECT_TRUE(known("", "", NoiseSource::kAuto, calibration("all.json")).calibration);
}

TEST_F(EvaluationNoiseTest, IsOfTheSpareSamplesOrOfRestAsTheSourceSays) {
  const auto told = [&](NoiseSource source, bool spare) {
    const std::vector<std::span<const double>> samples = {spare ? std::span(spare_)
                                                                : std::span(spare_).first(1000)};
    return app::told_beforehand(known("", "", source), "x", samples, 1.0, 100.0);
  };
  EXPECT_EQ(told(NoiseSource::kAuto, true).by, NoiseKnownBy::kSpareSamples);
  EXPECT_EQ(told(NoiseSource::kCalibrated, true).by, NoiseKnownBy::kSpareSamples);
  EXPECT_EQ(told(NoiseSource::kStandstill, true).by, NoiseKnownBy::kNothing);
  EXPECT_EQ(told(NoiseSource::kImf1, true).by, NoiseKnownBy::kNothing);
  EXPECT_FALSE(told(NoiseSource::kAuto, true).learns);
  EXPECT_TRUE(told(NoiseSource::kAuto, false).learns);
  EXPECT_TRUE(told(NoiseSource::kStandstill, true).learns);
  EXPECT_FALSE(told(NoiseSource::kCalibrated, false).learns);
  EXPECT_FALSE(told(NoiseSource::kImf1, true).learns);
}

// z is at rest, and alone would be believed; x, which is not judged, moves in the first half minute.
TEST_F(EvaluationNoiseTest, IsLearnedWhereAllAxesOfTheRecordAreAtRest) {
  const Signal x = white_noise(9000, 7);
  const Signal z = white_noise(9000, 8);
  std::string text = "timestamp_s,gyro_x_dps,gyro_z_dps,truth_x_dps,truth_z_dps\n";
  for (std::size_t n = 0; n < 9000; ++n) {
    const double moved = n < 3000 ? 5.0 * std::sin(0.02 * static_cast<double>(n)) : 0.0;
    text += std::to_string(0.01 * static_cast<double>(n)) + "," + std::to_string(moved + 0.1 * x[n]) + "," +
            std::to_string(0.1 * z[n]) + "," + std::to_string(moved) + ",0\n";
  }
  folder_.write("in.csv", text);
  std::string still = "timestamp_s,gyro_x_dps,gyro_z_dps\n";
  for (std::size_t n = 0; n < 9000; ++n)
    still += std::to_string(0.01 * static_cast<double>(n)) + "," + std::to_string(0.1 * z[n]) + "," +
             std::to_string(0.1 * x[n]) + "\n";
  folder_.write("still.csv", still);
  app::EvaluationInput input;
  input.recording = folder_.path("in.csv");
  input.axes = {"z"};
  const auto measured = app::evaluation_rows(input).rows[0].noise;
  EXPECT_EQ(measured.by, NoiseKnownBy::kRest);
  EXPECT_GT(measured.from_sample.value_or(0), 4000U);
  input.noise = folder_.path("still.csv");  // all of it is added
  input.noise_scales = {1.0, 2.0};
  const auto rows = app::evaluation_rows(input).rows;
  EXPECT_GT(rows[0].noise.from_sample.value_or(0), 4000U);
  const double variance = core::noise_variance(rows[0].noise.course.back().model);
  EXPECT_NEAR(variance, 1.04 * 0.01, 0.0008);
  EXPECT_NEAR(core::noise_variance(rows[1].noise.course.back().model), 4.0 * variance, 1e-6);
  input.known.source = NoiseSource::kImf1;
  EXPECT_FALSE(app::evaluation_rows(input).rows[0].noise.from_sample);
}

}  // namespace
}  // namespace gyrod
