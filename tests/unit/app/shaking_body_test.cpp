// A sensor on a body that shakes, from its first sample on, with nothing known of its noise: what the engine makes of its axes together.
#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "app/angle_units.hpp"
#include "app/record_denoiser.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr double kShakingRateHz = 100.0;
constexpr std::size_t kShaken = 2000;
constexpr double kOwnNoise = 0.1;  // deg/s

/// Error over that of raw samples, in samples from `begin` to `end`, all axes.
double over_raw(app::EstimateKind kind, std::size_t begin, std::size_t end) {
  constexpr std::array kAxis = {1.8, -2.0, 1.4};  // deg/s
  const Signal shaking = white_noise(kShaken, 10);
  files::Record record;
  record.sample_rate_hz = kShakingRateHz;
  std::array<Signal, 3> noise;
  for (std::size_t axis = 0; axis < 3; ++axis)
    noise[axis] = times(white_noise(kShaken, 11 + static_cast<unsigned>(axis)), kOwnNoise);
  for (std::size_t n = 0; n < kShaken; ++n) {
    record.time_s.push_back(static_cast<double>(n) / kShakingRateHz);
    for (std::size_t axis = 0; axis < 3; ++axis)
      record.gyro_radps[axis].push_back(app::kRadPerDeg * (kAxis[axis] * shaking[n] + noise[axis][n]));
  }
  const auto published = app::estimate_record(record, {}, kind);
  double error = 0.0;
  double raw = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t n = begin; n < end; ++n) {
      error += std::pow(app::kDegPerRad * published[axis][n] - kAxis[axis] * shaking[n], 2);
      raw += std::pow(noise[axis][n], 2);
    }
  }
  return std::sqrt(error / raw);
}

// White shaking of all axes is noise to each by itself: answers would be off by 15 times the noise.
TEST(ShakingBody, IsKeptByAnEngineThatKnowsNothingOfTheNoise) {
  for (const auto kind : {app::EstimateKind::kDenoised, app::EstimateKind::kRealtime})
    EXPECT_LT(over_raw(kind, 200, kShaken), 1.02);
}

// From the twelfth sample on axes are compared, from the first model on by bands.
TEST(ShakingBody, IsKeptBeforeTheFirstModel) {
  for (const auto kind : {app::EstimateKind::kDenoised, app::EstimateKind::kRealtime}) {
    EXPECT_LT(over_raw(kind, 20, 64), 2.5);
    EXPECT_LT(over_raw(kind, 64, 200), 1.5);
  }
}

}  // namespace
}  // namespace gyrod
