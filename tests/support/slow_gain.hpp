/// How much of slow motion an estimator leaves, as the guard `scale-factor` has it.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/evaluation/statistics.hpp"

namespace gyrod::test {

/// What was taken away, in means over a second, regressed on the truth's. Samples come one after the other.
class SlowGain {
 public:
  explicit SlowGain(double rate_hz) : second_(static_cast<std::size_t>(rate_hz)) {}

  void add(double truth, double taken) {
    truth_ += truth / static_cast<double>(second_);
    taken_ += taken / static_cast<double>(second_);
    if (++count_ % second_ != 0) return;
    truths_.push_back(std::exchange(truth_, 0.0));
    takens_.push_back(std::exchange(taken_, 0.0));
  }
  [[nodiscard]] double value() const {
    const auto slope = core::batch_slope(truths_, takens_, 10);
    return 1.0 + (slope ? slope->value : 0.0);
  }

 private:
  std::size_t second_;
  std::size_t count_ = 0;
  double truth_ = 0.0;
  double taken_ = 0.0;
  std::vector<double> truths_;
  std::vector<double> takens_;
};

}  // namespace gyrod::test
