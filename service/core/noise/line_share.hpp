/// How much of a spectrum is in narrow lines.
#pragma once

#include "core/noise/noise_fit.hpp"

namespace gyrod::core {

/// How much of the power above bias stands out of its neighbourhood. White noise has 0.06 in all from two segments, 0.02 from four.
struct LineShares {
  /// sum over k >= 3 of max(0, S_k - 2.5 median of S_(k-12) .. S_(k+12)) / sum over k >= 3 of S_k,   0..1.
  /// Broad shapes, such as a sensor's low-pass filter, count as nothing; an engine's tone and its harmonics count in full.
  double all = 0.0;
  /// Without the two strongest lines: what stands out within four bins of the highest one, or 6 % of its frequency where that is more, and then
  /// of the highest of the others, is left out of the lines. A sensor has one, seldom two; a road and an engine with its harmonics have many.
  double further = 0.0;
};

/// @return 0 and 0 where there is no power
/// Allocates nothing; about 20 us.
[[nodiscard]] LineShares line_shares(const NoiseSpectrum& power) noexcept;

}  // namespace gyrod::core
