/// How much of slow motion an estimator leaves, as the guard `scale-factor` has it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "core/evaluation/statistics.hpp"

namespace gyrod::test {

/// What was taken away, in means over a second, ten a second, regressed on the truth's. Samples come one after the other.
class SlowGain {
 public:
  explicit SlowGain(double rate_hz)
      : second_(static_cast<std::size_t>(rate_hz)), step_(std::max<std::size_t>(second_ / 10, 1)) {}

  void add(double truth, double taken) {
    truth_.push_back(truth);
    taken_.push_back(taken);
  }
  /// 1 with an infinite error where too little is known.
  [[nodiscard]] core::Measured gain() const {
    const auto slope = core::batch_slope(means(truth_), means(taken_), 10 * second_ / step_);
    if (!slope) return {1.0, std::numeric_limits<double>::infinity()};
    return {1.0 + slope->value, slope->standard_error};
  }

 private:
  [[nodiscard]] std::vector<double> means(std::span<const double> x) const {
    std::vector<double> means;
    for (std::size_t begin = 0; begin + second_ <= x.size(); begin += step_) {
      const auto second = x.subspan(begin, second_);
      means.push_back(std::accumulate(second.begin(), second.end(), 0.0) / static_cast<double>(second_));
    }
    return means;
  }

  std::size_t second_;
  std::size_t step_;
  std::vector<double> truth_;
  std::vector<double> taken_;
};

/// Whether the guard would fail: 0.005 off where two standard errors are less, or off by that and they.
inline bool fails(const core::Measured& gain) {
  constexpr double kLimit = 0.005;
  const double off = std::abs(gain.value - 1.0) - kLimit;
  const double error = 2.0 * gain.standard_error;
  return off > 0.0 && (error <= kLimit || off > error);
}

}  // namespace gyrod::test
