/// Signals of three axes for the tests of rest detection.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>

#include "core/noise/rest_detector.hpp"
#include "support/signals.hpp"

namespace gyrod::testing {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Three axes, rad/s.
using Axes = std::array<Signal, 3>;

/// Independent white noise of this many deg/s about a bias of 0.3, -0.5 and 1 deg/s.
inline Axes still_axes(std::size_t size, double level_dps, unsigned seed) {
  constexpr std::array<double, 3> kBias = {0.3, -0.5, 1.0};
  Axes axes;
  for (unsigned a = 0; a < 3; ++a) {
    axes[a] = times(white_noise(size, 3 * seed + a), level_dps * kRadPerDeg);
    for (double& value : axes[a]) value += kBias[a] * kRadPerDeg;
  }
  return axes;
}

/// Adds to one axis an oscillation of this amplitude.
inline void add_tone(Axes& axes, std::size_t axis, double amplitude_dps, double cycles_per_sample) {
  axes[axis] =
      sum(std::move(axes[axis]), tone(axes[axis].size(), cycles_per_sample), amplitude_dps * kRadPerDeg);
}

inline void add_rate(Axes& axes, std::size_t axis, double rate_dps) {
  for (double& value : axes[axis]) value += rate_dps * kRadPerDeg;
}

/// Steps a RestDetector or a StandstillLearner through all samples, and calls `look` after each.
template <class Stepped, class Look>
void run(Stepped& stepped, const Axes& axes, Look&& look) {
  for (std::size_t n = 0; n < axes[0].size(); ++n) {
    stepped.step({axes[0][n], axes[1][n], axes[2][n]});
    look();
  }
}

}  // namespace gyrod::testing
