#include "core/joint/gain_correction.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {

double GainCorrection::Band::follow(double x, const JointOptions& options, const JointScale& scale) noexcept {
  mean += (x - mean) / scale.memory(options.gain_mean);
  const double moved = x - mean;
  const double samples = scale.memory(options.gain_band);
  once += (moved - once) / samples;
  twice += (once - twice) / samples;
  return moved;
}

double GainCorrection::apply(double sample, double answer, double noise_variance, double most,
                             const JointOptions& options, const JointScale& scale) noexcept {
  paid_ = 0.0;
  if (!begun_) answers_.mean = answer;
  begun_ = true;
  const double moved = answers_.follow(answer, options, scale);
  residuals_.follow(sample - answer, options, scale);
  following_ += (moved - following_) / scale.memory(options.gain_follow);
  const double memory = scale.memory(options.gain_memory);
  power_ += (answers_.twice * answers_.twice - power_) / memory;
  covariance_ += (answers_.twice * residuals_.twice - covariance_) / memory;
  const double full = power_ + options.gain_ridge * noise_variance;
  if (!std::isfinite(full) || !std::isfinite(covariance_)) {
    *this = {};
    return answer;
  }
  if (!(power_ > 0.0)) return answer;
  const double missing = std::max(0.0, most - std::abs(covariance_ / power_ - most));
  const double bound = options.gain_clip * std::sqrt(power_);
  const double surely = missing > 0.0 ? missing * missing / (missing + options.gain_doubt) : 0.0;
  paid_ = surely * (power_ / full) * std::clamp(following_, -bound, bound);
  return answer + paid_;
}

}  // namespace gyrod::core
