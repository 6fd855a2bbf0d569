/// Bridging of short gaps in uniformly sampled sequences.
#pragma once

#include <cstddef>

namespace gyrod::core {

/// Value at position `step` of `count` missing samples between two known ones, on the line between them:
///   left + (right - left) (step + 1) / (count + 1),   step = 0..count-1.
/// A line, not a spline: it invents no extrema, so the EMD sees no oscillation that was not measured.
/// Finite for finite ends. Pure; allocates nothing.
[[nodiscard]] inline double bridge(double left, double right, std::size_t step, std::size_t count) noexcept {
  const double share = (static_cast<double>(step) + 1.0) / (static_cast<double>(count) + 1.0);
  return (1.0 - share) * left + share * right;
}

}  // namespace gyrod::core
