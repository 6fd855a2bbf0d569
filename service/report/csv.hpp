/// The report's numbers as CSV.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/json.hpp"

namespace gyrod::report {

/// Rows as CSV with a header line. A row is an object; an object in it becomes columns outer_inner, an array one cell with
/// blanks between its values, null an empty cell. Columns are those of the first row. Text is quoted where needed.
/// @return nothing but a line end for no rows
[[nodiscard]] std::string table_csv(const Json& rows);

/// One column of a series file.
struct Column {
  std::string name;
  std::span<const double> values;
  double factor = 1.0;
};

using Sink = std::function<void(std::string_view)>;

/// Writes series of equal length, a row a sample, 9 significant digits, in pieces of some 100 kB.
/// @param first    name of the first column, which counts n * step
/// @pre columns is not empty, all are of one length
void write_series(const std::string& first, double step, const std::vector<Column>& columns,
                  const Sink& sink);

}  // namespace gyrod::report
