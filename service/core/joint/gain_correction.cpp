#include "core/joint/gain_correction.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {

double GainCorrection::apply(double sample, double answer, double noise_variance, const JointOptions& options,
                             const JointScale& scale) noexcept {
  paid_ = 0.0;
  const double mean = scale.duration(options.gain_mean);
  const double band = scale.duration(options.gain_band);
  if (!begun_) answers_.begin(answer);
  begun_ = true;
  const double moved = answers_.follow(answer, mean, band);
  residuals_.follow(sample - answer, mean, band);
  following_ += (moved - following_) / scale.duration(options.gain_follow);
  const double memory = scale.duration(options.gain_memory);
  power_ += (answers_.slow() * answers_.slow() - power_) / memory;
  covariance_ += (answers_.slow() * residuals_.slow() - covariance_) / memory;
  const double full = power_ + options.gain_ridge * noise_variance;
  if (!std::isfinite(full) || !std::isfinite(covariance_)) {
    *this = {};
    return answer;
  }
  if (!(power_ > 0.0)) return answer;
  const double missing =
      std::max(0.0, options.most_gain - std::abs(covariance_ / power_ - options.most_gain));
  const double bound = options.gain_clip * std::sqrt(power_);
  paid_ = missing * (power_ / full) * std::clamp(following_, -bound, bound);
  return answer + paid_;
}

}  // namespace gyrod::core
