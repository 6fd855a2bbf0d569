/// What a bank's estimate is given back of slow motion. Internal to core/joint.
#pragma once

#include <span>

#include "core/joint/joint_options.hpp"
#include "core/joint/slow_motion.hpp"

namespace gyrod::core {

/// How much an estimate rests on the samples: variances of its error over the noise's, at least 0; may be infinite. And what else is known.
struct Trust {
  double now = 0.0;       ///< P, with what the members differ by
  double expected = 0.0;  ///< P as the members expect it
  double settled = 0.0;   ///< the same with the largest look-ahead there is
  /// Of what moves slowly, the strength (slow_motion.hpp).
  double motion = SlowMotion::kUntold;
};

/// Of one output. It makes of an estimate e and the sample z that it is of the answer
///   out = e + c (owed + z - e + residual_weight sum_k (1 - residual_decay c)^k d_k),   owed <- owed + z - out,
///   c = max(correction_rate (still_correction + (1 - still_correction) moving(motion_high)), correction_share now (0.1 at the most),
///           min(steady_correction s^3 b, most_steady_correction) moving(motion_steady)),
///   moving(high) = (motion - motion_low) / (high - motion_low), between 0 and 1,
///   s <- min(settled, s + (settled - s) / steady_memory),   b = settled / expected max(1, now / expected),
/// with correction_rate, what comes of correction_share, both most_ and steady_memory at the model's scale, and d_k the residual k samples later, as far as the answer waits for it: what no
/// model expects still arrives, hardly late, and the sum of the answers stays with that of the samples. With look-ahead the last rate is
/// min(late_steady_correction s^4 b, most_late_steady_correction).
/// A filter weighs motion against noise, and what is as small as the noise comes out smaller; where the error has been large for long, as on a
/// road that shakes, slow noise hardly adds to it; where nothing slow moves there is nothing to give back. The error with look-ahead tells such a road from a turn. An answer with less look-ahead is
/// given back less, as the same noise weighs more in it, and one that the members dispute more.
/// A plain value; finite for finite arguments.
class SlowCorrection {
 public:
  /// @param newer d_1, d_2, ...: what estimates without look-ahead leave of the samples after this one; empty where there is no look-ahead
  /// @return out
  [[nodiscard]] double apply(double sample, double estimate, const Trust& trust, const JointOptions& options,
                             const JointScale& scale, std::span<const double> newer = {}) noexcept;
  /// What the last answer was given.
  [[nodiscard]] double paid() const noexcept { return paid_; }

 private:
  [[nodiscard]] double steady_rate(const Trust& trust, const JointOptions& options, const JointScale& scale,
                                   bool late) noexcept;

  double owed_ = 0.0;  ///< sum of samples less answers
  double paid_ = 0.0;
  double steady_ = 0.0;  ///< s
};

}  // namespace gyrod::core
