/// What modes beside a line of the noise are of it.
#pragma once

#include <span>

#include "core/joint/spectral_mode.hpp"

namespace gyrod::core {

/// A mode near the line, and its variance.
struct ModeNearLine {
  SpectralMode* mode = nullptr;
  double power = 0.0;
};

/// Sets the share of each mode. A line's power in a window varies, and the shape that it is taken for is a guess: modes at its place are the rest of it,
/// up to a quarter of its power in all, first the narrowest, which are most like a line. A mode that is more than that is motion in part, and where
/// it is twice as much, all of it.
/// @param modes their powers above 0; reordered
void share_with_line(double line_power, std::span<ModeNearLine> modes) noexcept;

}  // namespace gyrod::core
