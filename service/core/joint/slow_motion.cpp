#include "core/joint/slow_motion.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {

double SlowMotion::follow(double sample, double noise_variance, const JointOptions& options,
                          const JointScale& scale) noexcept {
  if (!begun_) fast_ = slow_ = sample;
  begun_ = true;
  const double a = scale.correction_rate(options.correction_rate);
  const double b = 1.0 / scale.memory(options.motion_mean);
  fast_ += a * (sample - fast_);
  slow_ += b * (sample - slow_);
  const double difference = fast_ - slow_;
  const double of_noise = noise_variance * (a - b) * (a - b) / (2.0 * (a + b));
  if (!std::isfinite(difference) || !std::isfinite(of_noise)) {
    *this = {};
    return kUntold;
  }
  if (!(of_noise > 0.0)) return kUntold;
  const double ratio = std::min(difference * difference / of_noise, options.motion_sure * kMostRatio);
  ratio_ += (std::min(ratio, kMostRatio) - ratio_) / scale.memory(options.motion_memory);
  return std::max(ratio_, ratio / options.motion_sure);
}

}  // namespace gyrod::core
