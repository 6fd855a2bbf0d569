/// From columns to a reference trajectory; shared by truth in the recording and truth in a file of its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/inertial/earth.hpp"
#include "files/column_names.hpp"
#include "files/navigation_columns.hpp"

namespace gyrod::files {

/// Prefixes of all references that the columns hold, in alphabetical order.
[[nodiscard]] std::vector<std::string> truth_prefixes(const ColumnMap& columns);

/// The prefix to take. @param wanted with or without its "_" at the end; nothing: the only one
/// @return nothing if none is wanted and there is none
/// @throws FileError as truth_columns() does. @param name of the file
[[nodiscard]] std::optional<std::string> chosen_prefix(const ColumnMap& columns, const std::string& name,
                                                       const std::optional<std::string>& wanted);

/// @pre prefix is one of truth_prefixes(); time_s is as long as the columns and rises
[[nodiscard]] NavigationTruth build_truth(const ColumnMap& columns, const std::string& prefix,
                                          std::vector<double> time_s,
                                          const core::GeodeticPosition& reference);

}  // namespace gyrod::files
