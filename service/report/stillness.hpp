/// Whether a record was made at rest.
#pragma once

#include <span>

namespace gyrod::report {

/// What decides on it, in the unit of the record.
struct Stillness {
  double slow_motion =
      0.0;  ///< standard deviation of the means over 1 s (over N/10 samples, if that is less)
  double sample_noise = 0.0;  ///< sqrt(mean (x[n+1] - x[n])^2 / 2): all of the noise, if it is white
  [[nodiscard]] bool still() const noexcept { return slow_motion <= sample_noise; }
};

/// White noise alone has slow_motion / sample_noise = 1 / sqrt(samples a mean); drift of a MEMS gyro within hours stays below
/// 1; a turning sensor has 10 and more. A constant record, or an empty one, is still.
/// @param record finite  @param sample_rate_hz above 0
[[nodiscard]] Stillness stillness(std::span<const double> record, double sample_rate_hz);

}  // namespace gyrod::report
