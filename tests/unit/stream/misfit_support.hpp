/// What the tests of the flag `model_misfit` have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gyrod::stream {

/// Of the noise, rad/s.
inline constexpr double kStd = 0.006;

/// Lengths of the spells, but for one that the end cuts.
inline std::vector<std::size_t> spells(const std::vector<bool>& misfit) {
  std::vector<std::size_t> lengths;
  std::size_t length = 0;
  for (const bool now : misfit) {
    if (!now && length > 0) lengths.push_back(length);
    length = now ? length + 1 : 0;
  }
  return lengths;
}

inline std::ptrdiff_t flagged(const std::vector<bool>& misfit) { return std::ranges::count(misfit, true); }

}  // namespace gyrod::stream
