/// What a block of samples says of a sensor that is, or is not, at rest.
#pragma once

#include <array>
#include <cstdint>

#include "core/allan/online_allan.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Allan sums of x, y, z.
using AllanCurves = std::array<core::AllanSums, kAxes>;

/// Made at the end of each block (core::RestDetector), of the last eight.
struct RestEvidence {
  double block_s = 0.0;
  /// The shape is that of rest: even, steady, without tone. Level and bias, which would have to be as usual, are not asked.
  bool looks_at_rest = false;
  std::array<double, kAxes> deviation_radps{};  ///< standard deviation of a sample
  std::array<double, kAxes> mean_radps{};
  std::array<double, kAxes> usual_deviation_radps{};  ///< calibrated, else learned; 0 while unknown
  std::array<double, kAxes> bias_radps{};             ///< learned
  double bias_s = 0.0;                                ///< of rest that it was learned from
  double sample_rate_hz = 0.0;                        ///< that the curves are of
  AllanCurves curves{};
};

}  // namespace gyrod::stream
