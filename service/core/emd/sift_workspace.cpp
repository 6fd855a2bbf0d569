#include "core/emd/sift_workspace.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// Knots at the most: every sample an extremum, and those beyond the ends.
std::size_t max_knots(std::size_t max_samples) { return max_samples + 2 * Extrema::kMaxAdded; }

/// Rows of the system at the most: whole chunks of both kinds, and the unit rows before the first.
std::size_t max_rows(std::size_t max_samples) {
  return 2 * SiftWorkspace::kWarmUp + max_knots(max_samples) + 2 * SiftWorkspace::kChunks +
         SiftWorkspace::kOvershoot;
}

/// Entries of the elimination at the most: one row for every 2 * kChunks knots.
std::size_t max_elimination(std::size_t max_samples) {
  return (max_knots(max_samples) / (2 * SiftWorkspace::kChunks) + SiftWorkspace::kWarmUp + 2) *
         SiftWorkspace::kRow;
}

}  // namespace

Extrema::Extrema(std::size_t max_samples)
    : position2(max_knots(max_samples) + SiftWorkspace::kOvershoot),
      value(max_knots(max_samples) + SiftWorkspace::kOvershoot) {}

SiftWorkspace::SiftWorkspace(std::size_t max_samples, BoundaryRule boundary_rule)
    : boundary(boundary_rule),
      signal(max_samples + 2 * kOvershoot),
      mean(max_samples + 2 * kOvershoot),
      rises(max_samples / 64 + 2),
      falls(max_samples / 64 + 2),
      extrema(max_samples),
      time(max_knots(max_samples) + kOvershoot),
      inverse_spacing(time.size()),
      slope(time.size()),
      sigma(max_rows(max_samples)),
      mean_value(time.size()),
      mean_sigma(time.size()),
      linear(time.size()),
      cubic(time.size()),
      off_diagonal(max_rows(max_samples), 0.0),
      diagonal(max_rows(max_samples), 1.0),
      right_side(max_rows(max_samples), 0.0),
      ratio(max_elimination(max_samples), 0.0),
      reduced(max_elimination(max_samples), 0.0) {}

}  // namespace gyrod::core
