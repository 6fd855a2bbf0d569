/// Whether one sees where an estimate was put together from pieces.
#pragma once

#include <optional>
#include <span>

#include "core/evaluation/contender.hpp"

namespace gyrod::core {

/// A second difference e[t-1] - 2 e[t] + e[t+1] is at a seam if the seam lies between two of its samples; a step e[t] - e[t-1], if t is
/// the first sample of a piece.
struct SeamFigures {
  double roughness = 0.0;  ///< rms of the second differences at seams / rms of those elsewhere
  double roughness_of_truth =
      0.0;  ///< the ratio that the truth has at these places; 0 where it is not known or does not move
  double outlier_share =
      0.0;  ///< of the second differences at seams beyond the 95 % quantile of |those elsewhere|
  double outlier_standard_error =
      0.0;                  ///< of that share where seams are like the rest: sqrt(0.05 0.95 / seams)
  double worst_step = 0.0;  ///< greatest |step| at a seam / standard deviation of the steps elsewhere
  /// What the same three are at the other places of the period lets expect of one more: four standard deviations above their mean, of the step
  /// by logarithms, and at least the largest. A few knocks, or second differences that go together over some hops, make more than white noise would.
  double roughness_by_chance = 0.0;
  double outlier_share_by_chance = 0.0;
  double worst_step_by_chance = 0.0;
};

/// @param truth as long as the estimate; NaN where it is not known
/// @return nothing for a contender without seams, for less than ten of them in the range, and where nothing moves elsewhere
[[nodiscard]] std::optional<SeamFigures> seam_figures(const Contender& contender,
                                                      std::span<const double> truth, SampleRange range);

}  // namespace gyrod::core
