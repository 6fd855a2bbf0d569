/// What a bank's estimate is given back of slow motion. Internal to core/joint.
#pragma once

#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// Of one output. It makes of an estimate e of variance P, and the sample z that it is of, the answer
///   out = e + c (owed + z - e),   owed <- owed + z - out,
///   c = max(correction_rate, correction_share r, min(steady_correction s^2, most_steady_correction)),
///   r = P / noise variance,   s <- min(r, s + (r - s) / steady_memory),
/// with the rate and the memory at the model's scale: what no model expects still arrives, and the sum of the answers stays with that of
/// the samples. A filter weighs motion against noise, and what is as small as the noise comes out smaller; where the error has been large
/// for long, slow noise hardly adds to it.
/// A plain value; finite for finite arguments.
class SlowCorrection {
 public:
  /// @param ratio r, at least 0; may be infinite @return out
  [[nodiscard]] double apply(double sample, double estimate, double ratio, const JointOptions& options,
                             const JointScale& scale) noexcept;
  /// What the last answer was given.
  [[nodiscard]] double paid() const noexcept { return paid_; }

 private:
  double owed_ = 0.0;  ///< sum of samples less answers
  double paid_ = 0.0;
  double steady_ = 0.0;  ///< s
};

}  // namespace gyrod::core
