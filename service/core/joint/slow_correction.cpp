#include "core/joint/slow_correction.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// Largest rate that a large variance asks for: ten samples.
constexpr double kMostCorrection = 0.1;
/// What the estimate's variance may count for, in parts of the noise's.
constexpr double kMostRatio = 1e6;

}  // namespace

double SlowCorrection::apply(double sample, double estimate, double ratio, const JointOptions& options,
                             const JointScale& scale) noexcept {
  ratio = std::min(ratio, kMostRatio);
  steady_ = std::min(ratio, steady_ + (ratio - steady_) / scale.steady_memory(options.steady_memory));
  const double rate =
      std::max({scale.correction_rate(options.correction_rate),
                std::min(options.correction_share * ratio, kMostCorrection),
                std::min(options.steady_correction * steady_ * steady_, options.most_steady_correction)});
  paid_ = rate * (owed_ + sample - estimate);
  const double answer = estimate + paid_;
  owed_ += sample - answer;
  return answer;
}

}  // namespace gyrod::core
