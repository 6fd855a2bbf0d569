/// Columns by their names.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gyrod::files {

/// As Record::others: values by name in lower case, all equally long.
using ColumnMap = std::map<std::string, std::vector<double>, std::less<>>;

/// For messages: "a, b, c", or "none".
[[nodiscard]] inline std::string names_of(const ColumnMap& columns) {
  std::string names;
  for (const auto& [name, values] : columns) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

}  // namespace gyrod::files
