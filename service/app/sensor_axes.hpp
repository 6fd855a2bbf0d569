/// All that a sensor measures, for what its axes tell of each other.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/noise_course.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// @param axis "z" or "-z"
[[nodiscard]] inline std::size_t axis_index(const std::string& axis) {
  return static_cast<std::size_t>(axis.back() - 'x');
}

/// x, y, z.
struct SensorAxes {
  std::array<std::vector<double>, stream::kAxes>
      noisy_dps;                                 ///< each as long as the others, or empty: not measured
  std::array<NoiseCourse, stream::kAxes> noise;  ///< what is known of it, deg/s
};

}  // namespace gyrod::app
