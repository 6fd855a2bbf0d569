/// What still passes for the same noise of the same sensor.
#pragma once

#include <cmath>
#include <numbers>

namespace gyrod::core {

/// Largest ratio of variances of one noise: eight blocks of 100 samples vary by 6 %, a sensor's level by 5 % in hours.
inline constexpr double kSameLevel = 1.5;
/// Largest distance of means of one bias, rad/s: 1 deg/s.
inline constexpr double kSameBias = std::numbers::pi / 180.0;
/// How much of what was learned is remembered, s: ten minutes.
inline constexpr double kNoiseMemorySeconds = 600.0;
/// A level above the learned one is believed where it lasts so long, s, with nothing as quiet as that in between.
inline constexpr double kOutvotedLevelSeconds = 1800.0;
/// Models are made anew where so much more of what they are made of has been learned.
inline constexpr double kRefit = 0.1;
/// Largest distance of sample rates, in parts of one of them: clocks and stamps are no better.
inline constexpr double kSameSampleRate = 0.02;

/// Whether a model for `model_hz`, above 0, holds at `hz`.
[[nodiscard]] inline bool is_same_rate(double hz, double model_hz) noexcept {
  return std::abs(hz - model_hz) <= kSameSampleRate * model_hz;
}

}  // namespace gyrod::core
