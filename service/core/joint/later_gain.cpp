#include "core/joint/later_gain.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {

void LaterGain::compare(double later, double at_once, const JointOptions& options,
                        const JointScale& scale) noexcept {
  const double mean = scale.duration(options.gain_mean);
  const double band = scale.duration(options.gain_band);
  if (!compared_) later_.begin(later);
  compared_ = true;
  later_.follow(later, mean, band);
  lacks_.follow(later - at_once, mean, band);
  const double memory = scale.duration(options.later_memory);
  power_ += (later_.slow() * later_.slow() - power_) / memory;
  covariance_ += (later_.slow() * lacks_.slow() - covariance_) / memory;
  if (!std::isfinite(power_) || !std::isfinite(covariance_)) *this = {};
}

double LaterGain::apply(double answer, double noise_variance, const JointOptions& options,
                        const JointScale& scale) noexcept {
  if (!begun_) answers_.begin(answer);
  begun_ = true;
  answers_.follow(answer, scale.duration(options.gain_mean), scale.duration(options.later_follow));
  const double full = power_ + options.gain_ridge * noise_variance;
  if (!std::isfinite(full) || !std::isfinite(answers_.once())) {
    *this = {};
    return answer;
  }
  if (!(power_ > 0.0)) return answer;
  const double lacks = std::clamp(covariance_ / power_, -options.most_later_loss, options.most_later_gain);
  const double bound = options.gain_clip * std::sqrt(power_);
  return answer + lacks * (power_ / full) * std::clamp(answers_.once(), -bound, bound);
}

}  // namespace gyrod::core
