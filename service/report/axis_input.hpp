/// What a section of the report is made from: one axis of a record.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "core/denoise/record_analysis.hpp"

namespace gyrod::report {

/// Rates in rad/s; the report shows deg/s.
struct AxisInput {
  std::string name;  ///< x, y or z
  double sample_rate_hz = 0.0;
  bool still = false;  ///< the whole record is, all axes
  std::span<const double>
      truth_radps;  ///< true rate, as long as the record, NaN where not known; empty: no truth
  const core::RecordAnalysis& analysis;

  [[nodiscard]] std::span<const double> record() const noexcept {
    return analysis.output(core::Scheme::kRaw);
  }
  [[nodiscard]] double period_s() const noexcept { return 1.0 / sample_rate_hz; }
};

/// Samples of the paper's record: 1 h at 100 Hz.
inline constexpr std::size_t kPaperSamples = 360'000;

}  // namespace gyrod::report
