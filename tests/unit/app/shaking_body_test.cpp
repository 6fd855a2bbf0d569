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
constexpr std::size_t kShaken = 800;
constexpr double kOwnNoise = 0.1;  // deg/s

/// A record of a body that shakes, what is true of it, and the error of its samples.
struct Shaken {
  files::Record record;
  std::array<Signal, 3> truth;  // deg/s
  std::array<Signal, 3> noise;  // deg/s
};

Shaken shaken() {
  constexpr std::array kAxis = {1.8, -2.0, 1.4};  // deg/s
  const Signal shaking = white_noise(kShaken, 10);
  Shaken made;
  made.record.sample_rate_hz = kShakingRateHz;
  for (std::size_t n = 0; n < kShaken; ++n)
    made.record.time_s.push_back(static_cast<double>(n) / kShakingRateHz);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.truth[axis] = times(shaking, kAxis[axis]);
    made.noise[axis] = times(white_noise(kShaken, 11 + static_cast<unsigned>(axis)), kOwnNoise);
    made.record.gyro_radps[axis] = times(sum(made.truth[axis], made.noise[axis]), app::kRadPerDeg);
  }
  return made;
}

// White shaking of all axes is noise to each by itself: answers would be off by 15 times the noise. From the twelfth sample on axes are compared,
// from the first model on by bands.
TEST(ShakingBody, IsKeptByAnEngineThatKnowsNothingOfTheNoise) {
  const Shaken body = shaken();
  for (const auto kind : {app::EstimateKind::kDenoised, app::EstimateKind::kRealtime}) {
    const auto published = app::estimate_record(body.record, {}, kind);
    const auto over_raw = [&](std::size_t begin, std::size_t end) {
      double error = 0.0;
      double raw = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t n = begin; n < end; ++n) {
          error += std::pow(app::kDegPerRad * published[axis][n] - body.truth[axis][n], 2);
          raw += std::pow(body.noise[axis][n], 2);
        }
      }
      return std::sqrt(error / raw);
    };
    EXPECT_LT(over_raw(20, 64), 2.5);
    EXPECT_LT(over_raw(64, 200), 1.5);
    EXPECT_LT(over_raw(200, kShaken), 1.02);
  }
}

}  // namespace
}  // namespace gyrod
