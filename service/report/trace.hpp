/// Long series made short enough to draw.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::report {

/// Values at even steps.
struct Trace {
  double step = 0.0;  ///< in the unit of the sample period that was given
  std::vector<double> values;
};

/// Points of a trace that stands for a whole record: more than a screen has pixels.
inline constexpr std::size_t kTracePoints = 3000;
/// Points where many traces stand under one another.
inline constexpr std::size_t kRowPoints = 2000;

/// A series of at most `most` values as it is; a longer one cut into most / 2 or fewer equal stretches, of each the least and
/// the greatest value in the order in which they come: no spike is lost.
/// @param period of a sample, any unit  @pre most >= 2
[[nodiscard]] Trace min_max_trace(std::span<const double> series, double period, std::size_t most);

}  // namespace gyrod::report
