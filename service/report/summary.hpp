/// What a report says in plain words, from its own numbers.
#pragma once

#include <string>
#include <vector>

#include "report/json.hpp"

namespace gyrod::report {

/// A row for each axis that was decomposed: standard deviation raw and improved, which frequencies are dropped, filtered and kept,
/// and, for a still record, how the Allan deviation changes.
/// @param axes  object of the axes' sections, as axis_report() makes them
[[nodiscard]] Json summary_rows(const Json& axes, bool still);

/// How much quieter the record gets, what that costs, which scheme is best.
[[nodiscard]] std::vector<std::string> summary_sentences(const Json& axes, bool still);

/// What a reader must know before using a number: motion, length, gaps.
/// @param record  the report's "record"
[[nodiscard]] std::vector<std::string> cautions(const Json& record);

}  // namespace gyrod::report
