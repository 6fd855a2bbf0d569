/// The Allan analysis as a table for people.
#pragma once

#include <string>

#include "app/allan_analysis.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::app {

/// The record, each channel's coefficients by all three methods in SI and data-sheet units with the figures per
/// sample, and the deviation at 0.01, 0.1, 1, ... s with its bounds.
/// @param unit in which a gyro's deviation is printed
[[nodiscard]] std::string allan_table(const AllanAnalysis& analysis, files::RateUnit unit);

}  // namespace gyrod::app
