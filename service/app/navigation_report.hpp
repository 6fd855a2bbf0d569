/// What `gyrod navigate` tells: tables, JSON, CSV.
#pragma once

#include <string>

#include "app/navigation_comparison.hpp"
#include "files/output_file.hpp"
#include "files/record.hpp"

namespace gyrod::app {

/// "improved" or "improved, 16 late": a run in words.
[[nodiscard]] std::string label_of(const NavigationRunResult& run);

/// For reading: what was assumed, then attitude, velocity and position errors as in [Yang2019] tables 7 to 9, then
/// one line a start. Quantities that the truth does not know are left out and named.
[[nodiscard]] std::string navigation_text(const files::Record& record, const NavigationResult& result);

/// All figures, with the unit in every key that has one.
[[nodiscard]] std::string navigation_json(const files::Record& record, const NavigationResult& result);

/// One row a sample, start and run; empty cells where the truth does not know.
/// @pre result was made with keep_series
void write_navigation_csv(const NavigationResult& result, files::OutputFile& file);

}  // namespace gyrod::app
