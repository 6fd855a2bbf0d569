/// How much of slow motion an estimator leaves, as the guard `scale-factor` has it. Link gyrod_core_evaluation.
#pragma once

#include <limits>
#include <vector>

#include "core/evaluation/guards.hpp"
#include "core/evaluation/statistics.hpp"

namespace gyrod::test {

/// What was taken away, regressed on the truth. Samples come one after the other.
class SlowGain {
 public:
  explicit SlowGain(double rate_hz) : rate_hz_(rate_hz) {}

  /// @param truth NaN where not known
  void add(double truth, double taken) {
    truth_.push_back(truth);
    taken_.push_back(taken);
  }
  /// 1 with an infinite error where too little is known.
  [[nodiscard]] core::Measured gain() const {
    const auto slope = core::slow_slope(truth_, taken_, rate_hz_);
    if (!slope) return {1.0, std::numeric_limits<double>::infinity()};
    return {1.0 + slope->value, slope->standard_error};
  }

 private:
  double rate_hz_;
  std::vector<double> truth_;
  std::vector<double> taken_;
};

/// Whether the guard would fail.
inline bool fails(const core::Measured& gain) {
  const core::Measured deviation{gain.value - 1.0, gain.standard_error};
  return !core::within(deviation, core::GuardLimits{}.scale_factor).value_or(true);
}

}  // namespace gyrod::test
