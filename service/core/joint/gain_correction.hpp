/// What an answer lacks of slow motion in size. Internal to core/joint.
#pragma once

#include "core/joint/joint_options.hpp"
#include "core/joint/slow_band.hpp"

namespace gyrod::core {

/// An answer of least error is smaller than motion that is hardly larger than the noise: by W where the filter's gain is W, and what it leaves of the
/// samples is then (1 - W) / W of it. So much is added to it. With low(x, T) the low-pass y <- y + (x - y) / T, and m(x) = x - low(x, gain_mean):
///   p = low(low(m(answer), gain_band), gain_band),   d the same of sample - answer,
///   A = low(p^2, gain_memory),   C = low(p d, gain_memory),   A and C from 0 on,
///   q = max(0, most_gain - |C / A - most_gain|),   k = q A / (A + gain_ridge R),
///   out = answer + k clamp(low(m(answer), gain_follow), -gain_clip sqrt(A), gain_clip sqrt(A)),
/// times in samples at the design's rate, and the same seconds at the model's, R the variance of the samples' noise. What would ask for twice the most is noise more than motion, and gets
/// nothing; a turn, against which the noise is small, shows a C / A near 0 and is beyond the clamp.
/// Costs little, as the error of an answer of least error is orthogonal to it: the square of k times the slow motion's variance. For answers with
/// look-ahead; those at once are compared with these (later_gain.hpp).
/// A plain value; finite for finite arguments.
class GainCorrection {
 public:
  /// @param sample that the answer is of
  /// @param noise_variance R, at least 0
  /// @return out
  [[nodiscard]] double apply(double sample, double answer, double noise_variance, const JointOptions& options,
                             const JointScale& scale) noexcept;
  /// What the last answer was given.
  [[nodiscard]] double paid() const noexcept { return paid_; }

 private:
  SlowBand answers_;
  SlowBand residuals_;
  double following_ = 0.0;
  double power_ = 0.0;       ///< A
  double covariance_ = 0.0;  ///< C
  double paid_ = 0.0;
  bool begun_ = false;
};

}  // namespace gyrod::core
