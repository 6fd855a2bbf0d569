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
  double sum = 0.0;
  for (const std::int64_t interval : intervals_) sum += static_cast<double>(interval);
  const auto middle = intervals_.begin() + kIntervals / 2;
  std::nth_element(intervals_.begin(), middle, intervals_.end());
  const auto median = static_cast<double>(*middle);
  const auto near = std::count_if(intervals_.begin(), intervals_.end(), [median](std::int64_t interval) {
    return std::abs(static_cast<double>(interval) - median) <= kTolerance * median;
  });
  regular_ = static_cast<std::size_t>(near) >= kRegularIntervals;
  if (!configured_) period_ns_ = regular_ ? median : sum / static_cast<double>(kIntervals);
}

}  // namespace gyrod::stream
