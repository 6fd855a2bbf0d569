#include "core/joint/slow_correction.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// Largest rate that a large variance asks for: ten samples.
constexpr double kMostCorrection = 0.1;
/// What the estimate's variance may count for, in parts of the noise's.
constexpr double kMostRatio = 1e6;

}  // namespace

double SlowCorrection::apply(double sample, double estimate, const Trust& trust, const JointOptions& options,
                             const JointScale& scale) noexcept {
  const double settled = std::min(trust.settled, kMostRatio);
  const double expected = std::clamp(trust.expected, settled, kMostRatio);
  steady_ = std::min(settled, steady_ + (settled - steady_) / scale.steady_memory(options.steady_memory));
  const double now = std::min(trust.now, kMostRatio);
  const double steadiness =
      expected > 0.0 ? steady_ * steady_ * steady_ * settled / expected * std::max(now / expected, 1.0) : 0.0;
  const double rate =
      std::max({scale.correction_rate(options.correction_rate),
                std::min(options.correction_share * now, kMostCorrection),
                std::min(options.steady_correction * steadiness, options.most_steady_correction)});
  paid_ = rate * (owed_ + sample - estimate);
  const double answer = estimate + paid_;
  owed_ += sample - answer;
  return answer;
}

}  // namespace gyrod::core
