/// What a line of a spectrum stands out of.
#pragma once

#include <cstddef>

#include "core/noise/noise_fit.hpp"

namespace gyrod::core {

/// Lowest bin of a segment's spectrum that tells of noise: below it are bias and its drift.
inline constexpr std::size_t kFirstNoiseBin = 3;

/// Median of the bins within `reach` of this one, from kFirstNoiseBin to the last; the upper one of two. Allocates nothing.
/// @pre kFirstNoiseBin <= bin < kNoiseBins
[[nodiscard]] double median_around(const NoiseSpectrum& power, std::size_t bin, std::size_t reach) noexcept;

}  // namespace gyrod::core
