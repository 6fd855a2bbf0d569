/// What the axes of a sensor tell of each other's noise.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/signal/cross_power.hpp"

namespace gyrod::core {

/// The axes of a gyro have noise of a size: an axis that seems to have more than this, in variance, than the quietest, shakes. At rest
/// they differ by 1.5 (ADIS16405) to 2.2 (MPU6050).
inline constexpr double kMostOfQuietest = 2.0;

/// Least variance above 0 of the noise of the axes but this one; 0 where there is none.
[[nodiscard]] inline double least_of_others(const std::array<double, kSensorAxes>& variance,
                                            std::size_t axis) noexcept {
  double least = 0.0;
  for (std::size_t other = 0; other < kSensorAxes; ++other) {
    if (other == axis || !(variance[other] > 0.0)) continue;
    least = least > 0.0 ? std::min(least, variance[other]) : variance[other];
  }
  return least;
}

}  // namespace gyrod::core
