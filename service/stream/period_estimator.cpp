#include "stream/period_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::stream {

PeriodEstimator::PeriodEstimator(double rate_hz) noexcept
    : configured_(rate_hz > 0.0), period_ns_(configured_ ? 1e9 / rate_hz : 0.0), regular_(configured_) {}

void PeriodEstimator::add(std::int64_t interval_ns) noexcept {
  intervals_[count_++] = interval_ns;
  if (count_ < kIntervals) return;
  evaluate();
  count_ = 0;
}

void PeriodEstimator::evaluate() noexcept {
  const auto middle = intervals_.begin() + kIntervals / 2;
  std::nth_element(intervals_.begin(), middle, intervals_.end());
  const auto median = static_cast<double>(*middle);
  double sum = 0.0;
  double near_sum = 0.0;
  std::size_t near = 0;
  catches_up_ = false;
  for (const std::int64_t interval : intervals_) {
    sum += static_cast<double>(interval);
    catches_up_ = catches_up_ || static_cast<double>(interval) < 0.5 * median;
    if (std::abs(static_cast<double>(interval) - median) > kTolerance * median) continue;
    near_sum += static_cast<double>(interval);
    ++near;
  }
  regular_ = near >= kRegularIntervals;
  // Not the median itself: of stamps in whole milliseconds that is a whole number of them, up to 11 % off.
  if (!configured_)
    period_ns_ = regular_ ? near_sum / static_cast<double>(near) : sum / static_cast<double>(kIntervals);
}

}  // namespace gyrod::stream
