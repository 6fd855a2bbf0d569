/// The limits of what counts as rest: docs/noise.md.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/signal/portable_math.hpp"

namespace gyrod::core::rest_rules {

/// Logarithms of block variances differ by sqrt(2 / n); real, coloured noise keeps eight to twelve of them within 6.3 of these.
inline constexpr double kEvenDeviations = 7.5;
/// A real sensor's level is not constant beyond this.
inline constexpr double kMostEvenSamples = 400.0;
inline constexpr double kSteady = 8.0;
/// Accelerometers flicker more, and far more when they are moved.
inline constexpr double kSteadyAccelerometer = 24.0;
/// Two thousandths of gravity: the last digit of a coarse accelerometer, far below any road.
inline constexpr double kMotionless_mps2 = 0.02;
/// Of one axis. Still sensors have up to 0.28 (an ADIS16405's 20 Hz line), idling cars from 0.5 to 0.98.
inline constexpr double kTone = 0.4;
/// Fewer segments leave the spectrum of noise itself full of lines.
inline constexpr double kFewestSegments = 2.0;
/// LineShares::further that all axes but one keep to by chance, of so few segments: 0.054 in 999 of 1000 spectra of white noise, 0.041 in 99 of 100 of
/// still ADIS16405s. Of three segments it is 0.021, of four 0.009, of six 0.002.
inline constexpr double kFurther = 0.055;
/// Sensors do have weak lines.
inline constexpr double kLeastFurther = 0.005;

/// How far apart the variances of blocks of so many samples may be, as a ratio.
[[nodiscard]] inline double most_uneven(double samples) noexcept {
  return portable_exp(kEvenDeviations * std::sqrt(2.0 / std::min(samples, kMostEvenSamples)));
}

/// Most that LineShares::further may be on all axes but one. Falls as the power 9/4 of the number of segments. Narrow noise is in fewer bins, of
/// which more stands out.
[[nodiscard]] inline double most_further(double segments, double independent) noexcept {
  const double fewer = kFewestSegments / segments;
  const double by_chance = kFurther * fewer * fewer * std::sqrt(std::sqrt(fewer)) / independent;
  return std::max(by_chance, kLeastFurther);
}

}  // namespace gyrod::core::rest_rules
