#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/angle_units.hpp"
#include "app/noise_calibrator.hpp"

namespace gyrod {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// 0.1 deg/s on each axis at 200 Hz; half of y's power is in a line at a quarter of the rate.
settings::NoiseCalibration with_a_line() {
  const double variance = 0.01 * app::kRadPerDeg * app::kRadPerDeg;
  settings::NoiseCalibration calibration;
  calibration.sample_rate_hz = 200.0;
  for (core::NoiseModel& model : calibration.models) model = core::white_noise(variance);
  core::NoiseModel& y = calibration.models[1];
  y = core::white_noise(0.5 * variance);
  y.line_count = 1;
  y.line[0] = {.cycles = 0.25, .half_width = 0.003, .variance = 0.5 * variance};
  return calibration;
}

TEST(CalibrationTable, SaysWhichAxisHasALineWhereAndHowStrong) {
  const std::string text = app::calibration_table(with_a_line());
  // sqrt(0.5) of 0.1 deg/s.
  EXPECT_THAT(text, HasSubstr("y has a narrow line at 50 Hz: 0.0707 deg/s, 50 % of its noise's power\n"));
  EXPECT_THAT(text, Not(HasSubstr("x has")));
  EXPECT_THAT(text, Not(HasSubstr("z has")));
}

TEST(CalibrationTable, SaysWhichAxisHasNoNoise) {
  settings::NoiseCalibration calibration = with_a_line();
  calibration.models[0] = {};
  EXPECT_THAT(app::calibration_table(calibration), HasSubstr("x    no noise: not there, or never changes\n"));
}

}  // namespace
}  // namespace gyrod
