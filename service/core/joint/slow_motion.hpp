/// Whether anything slow moves. Internal to core/joint.
#pragma once

#include <limits>

#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// Compares what is slow in the samples with what noise makes of it:
///   f <- f + a (z - f),   g <- g + b (z - g),   d = f - g,   a = correction_rate,   b = 1 / motion_mean,
///   E = R (a - b)^2 / (2 (a + b)),   m <- m + (min(d^2 / E, 50) - m) / motion_memory,   m = 50 at the start,
///   strength = max(m, d^2 / (motion_sure E)),
/// with times at the model's scale. E is the variance of d where the samples are white noise of variance R, or noise that is as strong as that where it is
/// slow; real noise, whose bias wanders, has up to 1.5 times as much. A turn is seen at once, and forgotten within 20 s after
/// d has become small again.
/// A plain value; finite for finite arguments.
class SlowMotion {
 public:
  /// The strength where nothing can be told: all may move.
  static constexpr double kUntold = std::numeric_limits<double>::infinity();

  /// Takes z.
  /// @param noise_variance R, at least 0: of white noise as strong as the samples' own where that is slow (BankModel::slow_noise_variance)
  /// @return strength, at least 0: about 1 where nothing slow is seen but noise; kUntold where there is no noise to compare with, or no number
  [[nodiscard]] double follow(double sample, double noise_variance, const JointOptions& options,
                              const JointScale& scale) noexcept;

 private:
  /// Beyond this it does not matter how much it is.
  static constexpr double kMostRatio = 50.0;

  double fast_ = 0.0;          ///< f
  double slow_ = 0.0;          ///< g
  double ratio_ = kMostRatio;  ///< m
  bool begun_ = false;
};

}  // namespace gyrod::core
