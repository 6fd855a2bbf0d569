/// The still stretches of a recording.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/noise/rest_detector.hpp"

namespace gyrod::core {

/// Samples first .. first + size - 1.
struct Stretch {
  std::size_t first = 0;
  std::size_t size = 0;
};

struct StillSearch {
  std::vector<Stretch> stretches;  ///< in order, apart
  std::size_t still = 0;           ///< samples in them
  /// Samples in stretches that look still but are louder than 1.5 times the quietest one's variance on some axis: a smooth road, a smooth
  /// engine. They are not among the above.
  std::size_t louder = 0;
  /// Samples in stretches that look still but in which an axis does not change that does elsewhere: it is stuck. Nor are they among the above.
  std::size_t stuck = 0;
  /// Samples in stretches whose mean on some axis is more than 1 deg/s off what most of the others have: a slow constant turn. Nor are they.
  std::size_t turning = 0;
  /// Samples by RestVerdict, of all.
  std::array<std::size_t, 6> verdicts{};
};

/// Rates, rad/s, and specific forces, m/s^2, or nothing, of equal sizes.
struct StillInput {
  std::array<std::span<const double>, 3> rate;
  std::array<std::span<const double>, 3> accelerometer;
  /// Not 0 where a sample was bridged by a straight line; empty where none was.
  std::span<const std::uint8_t> bridged = {};
};

/// Joins the windows that a RestDetector takes for rest, and leaves out those in which an axis is stuck, those that are louder than the
/// quietest, and those that turn.
/// @param go_on called now and then with the part that is done, 0..1; false stops early. May be empty
/// @pre sample_rate_hz > 0; samples finite
[[nodiscard]] StillSearch find_still(const StillInput& input, double sample_rate_hz,
                                     const std::function<bool(double done)>& go_on = {});

}  // namespace gyrod::core
