/// Figures 8 and 9 and Table 5: before and after, by every scheme.
#pragma once

#include <optional>
#include <span>

#include "report/axis_input.hpp"
#include "report/json.hpp"

namespace gyrod::report {

/// Figures 8 and 9: the whole record before and after, and a stretch of 10 s of every sample with all schemes.
[[nodiscard]] Json before_after_section(const AxisInput& input);

/// What an output is compared with: the same for all schemes of an axis.
struct SnrReference {
  std::span<const double> truth;  ///< NaN where it is not known; empty: `level` throughout
  double level = 0.0;
  double signal = 0.0;  ///< S
};

/// SNR = 20 log10(S / E) dB, E = sqrt(mean (y - s)^2).
///   Still record: s = mean of the record, S = |s|.   With truth: s = truth, S its standard deviation, E without the mean of y - s.
/// An output of zeros has 0 dB by either rule: shrinking earns nothing. The page's definition says the same.
/// @return nothing where E or S is 0
[[nodiscard]] std::optional<double> snr_db(std::span<const double> output, const SnrReference& reference);

/// Table 5, a row a scheme; "paper" with the paper's figures where the record is a still one.
[[nodiscard]] Json table5_section(const AxisInput& input);

}  // namespace gyrod::report
