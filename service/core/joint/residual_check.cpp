#include "core/joint/residual_check.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::core {

BankEstimate ResidualCheck::apply(double sample, BankEstimate estimate, double expected_variance,
                                  double beside, const JointOptions& options) noexcept {
  if (!(expected_variance > 0.0) || !std::isfinite(expected_variance)) return estimate;
  const double residual = sample - estimate.rate;
  const double most = std::max(options.lone_limit * beside / expected_variance, 1.0);
  const double square = std::min({residual * residual / expected_variance, most, kMostSurprise});
  mean_square_ += (std::min(square, kMostToMean) - mean_square_) / options.residual_memory;
  const double alone = square > options.residual_limit ? square : 0.0;
  const double lately = mean_square_ > options.residual_mean_limit ? mean_square_ : 0.0;
  if (alone == 0.0 && lately == 0.0) return estimate;
  double weight = 0.0;
  if (alone > 0.0) weight = 1.0 - options.residual_limit / alone;
  if (lately > 0.0) weight = std::max(weight, 1.0 - options.residual_mean_limit / lately);
  const double off = std::max(alone, lately) - 1.0;  // the estimate's own error squared, in parts of R
  const double variance = expected_variance * ((1.0 - weight) * (1.0 - weight) * off + weight * weight);
  return {.rate = estimate.rate + weight * residual, .variance = std::max(estimate.variance, variance)};
}

}  // namespace gyrod::core
