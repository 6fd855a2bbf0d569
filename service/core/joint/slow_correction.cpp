#include "core/joint/slow_correction.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {
namespace {

/// Largest rate that a large variance asks for, at the design's sample rate: ten samples.
constexpr double kMostCorrection = 0.1;
/// What the estimate's variance may count for, in parts of the noise's.
constexpr double kMostRatio = 1e6;

/// Whether anything slow moves, 0 .. 1: surely from this strength on.
double moving(const Trust& trust, double sure, const JointOptions& options) noexcept {
  return std::clamp((trust.motion - options.motion_low) / (sure - options.motion_low), 0.0, 1.0);
}

}  // namespace

double SlowCorrection::apply(double sample, double estimate, const Trust& trust, const JointOptions& options,
                             const JointScale& scale, std::span<const double> newer) noexcept {
  const double now = std::min(trust.now, kMostRatio);
  const double rate =
      std::max({scale.correction_rate(options.correction_rate) *
                    std::lerp(options.still_correction, 1.0, moving(trust, options.motion_high, options)),
                scale.pace(std::min(options.correction_share * now, kMostCorrection)),
                steady_rate(trust, options, scale, !newer.empty())});
  const double kept = std::max(1.0 - options.residual_decay * rate, 0.0);
  double weight = options.residual_weight;
  double coming = 0.0;
  for (const double residual : newer) {
    weight *= kept;
    coming += weight * residual;
  }
  paid_ = rate * (owed_ + sample - estimate + coming);
  const double answer = estimate + paid_;
  owed_ += sample - answer;
  return answer;
}

/// Where the estimate has trusted the samples for long.
double SlowCorrection::steady_rate(const Trust& trust, const JointOptions& options, const JointScale& scale,
                                   bool late) noexcept {
  const double now = std::min(trust.now, kMostRatio);
  const double settled = std::min(trust.settled, kMostRatio);
  const double expected = std::clamp(trust.expected, settled, kMostRatio);
  steady_ = std::min(settled, steady_ + (settled - steady_) / scale.memory(options.steady_memory));
  if (!(expected > 0.0)) return 0.0;
  const double cube = steady_ * steady_ * steady_;
  const double given_back = settled / expected * std::max(now / expected, 1.0);
  const double rate =
      late ? options.late_steady_correction * cube * steady_ : options.steady_correction * cube;
  const double most = late ? options.most_late_steady_correction : options.most_steady_correction;
  return moving(trust, options.motion_steady, options) * std::min(rate * given_back, scale.pace(most));
}

}  // namespace gyrod::core
