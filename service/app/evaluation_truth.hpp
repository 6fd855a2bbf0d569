/// The columns of a recording that hold the rates of a better gyro.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/evaluation_rows.hpp"
#include "files/record.hpp"

namespace gyrod::app {

/// Beginning of the columns that hold the truth of all axes of the input: the prefix that it names, or the first of truth_ and ref_gyro_ that has all.
/// @param record with its other columns
/// @throws files::FileError that says which axis lacks what: a column, a unit that is known, or numbers
[[nodiscard]] std::string truth_prefix(const files::Record& record, const EvaluationInput& input);

/// The rates in column PREFIXx_UNIT, for axis "x", "-x", ..., deg/s; NaN where the cell is no number. Empty where there is no such column with a known
/// unit and a number.
[[nodiscard]] std::vector<double> truth_rates(const files::Record& record, const std::string& prefix,
                                              const std::string& axis);

/// What of the truth is within the signal band, up to this frequency (core::SignalBand). Gaps of up to a quarter of the limit's period are bridged by
/// straight lines; NaN as far as the low-pass reaches from longer ones and from the ends.
/// @param max_signal_hz 0, or half the sample rate and more: all of it
[[nodiscard]] std::vector<double> within_band(std::span<const double> truth, double rate_hz,
                                              double max_signal_hz);

}  // namespace gyrod::app
