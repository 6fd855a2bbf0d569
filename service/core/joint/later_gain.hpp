/// What an answer at once lacks of slow motion in size, as later answers show. Internal to core/joint.
#pragma once

#include "core/joint/joint_options.hpp"
#include "core/joint/slow_band.hpp"

namespace gyrod::core {

/// An answer with look-ahead knows the size of slow motion better than one at once, and comes a fraction of a second later: on a road the one at once
/// stays behind it by some per cent, after a slow correction it may be beyond it. So the two answers of one sample are compared, and those at once
/// are from then on made larger or smaller by what they differ. With low(x, T) the low-pass y <- y + (x - y) / T, and m(x) = x - low(x, gain_mean):
///   p = low(low(m(later), gain_band), gain_band),   d the same of later - at once,
///   A = low(p^2, later_memory),   C = low(p d, later_memory),   A and C from 0 on,
///   k = C / A, between -most_later_loss and most_later_gain,
///   out = answer + k A / (A + gain_ridge R) clamp(low(m(answer), later_follow), -gain_clip sqrt(A), gain_clip sqrt(A)),
/// times in samples at the design's rate, and the same seconds at the model's, R the variance of the samples' noise. The answers that are compared are those before this, so that what is
/// learned does not depend on what it does.
/// A plain value; finite for finite arguments.
class LaterGain {
 public:
  /// @param later answer with look-ahead
  /// @param at_once what apply() was given for the same sample
  void compare(double later, double at_once, const JointOptions& options, const JointScale& scale) noexcept;
  /// @param noise_variance R, at least 0
  /// @return out
  [[nodiscard]] double apply(double answer, double noise_variance, const JointOptions& options,
                             const JointScale& scale) noexcept;

 private:
  SlowBand later_;
  SlowBand lacks_;
  SlowBand answers_;
  bool compared_ = false;
  bool begun_ = false;
  double power_ = 0.0;       ///< A
  double covariance_ = 0.0;  ///< C
};

}  // namespace gyrod::core
