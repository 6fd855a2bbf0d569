#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/signal/interpolation.hpp"
#include "files/accelerometer_units.hpp"
#include "files/column_names.hpp"
#include "files/file_error.hpp"
#include "files/navigation_columns.hpp"

namespace gyrod::files {
namespace {

/// Unit of the three columns, or nothing where they are not all there.
const AccelUnit* unit_of(const ColumnMap& columns) {
  const auto has_all = [&columns](const AccelUnit& unit) {
    return columns.contains(accel_column(0, unit)) && columns.contains(accel_column(1, unit)) &&
           columns.contains(accel_column(2, unit));
  };
  const auto* found = std::ranges::find_if(kAccelUnits, has_all);
  return found == kAccelUnits.end() ? nullptr : found;
}

/// Bridges what is no number. @return samples bridged, or nothing with the place of a run that is too long
std::optional<std::size_t> bridge_gaps(std::vector<double>& values, std::size_t& too_long_at) {
  std::size_t bridged = 0;
  std::size_t n = 0;
  while (n < values.size()) {
    if (std::isfinite(values[n])) {
      ++n;
      continue;
    }
    const std::size_t first = n;
    while (n < values.size() && !std::isfinite(values[n])) ++n;
    too_long_at = first;
    const std::size_t count = n - first;
    if (count > kMostBridgedAccelSamples || count == values.size()) return std::nullopt;
    const double after = n < values.size() ? values[n] : values[first - 1];
    const double before = first > 0 ? values[first - 1] : after;
    for (std::size_t k = 0; k < count; ++k) values[first + k] = core::bridge(before, after, k, count);
    bridged += count;
  }
  return bridged;
}

[[noreturn]] void complain_of_gap(const Record& record, const std::string& column, std::size_t at) {
  char time[32];
  std::snprintf(time, sizeof time, "%.3f", record.time_s[at]);
  throw FileError(record.name + ": " + column + " has no number for more than " +
                  std::to_string(kMostBridgedAccelSamples) + " samples in a row, from " + time + " s on");
}

}  // namespace

Accelerometer accelerometer_of(const Record& record) {
  const AccelUnit* unit = unit_of(record.others);
  if (unit == nullptr) throw FileError(record.name + std::string(kNoAccelerometer) + names_of(record.others));
  Accelerometer accelerometer;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string column = accel_column(i, *unit);
    std::vector<double>& values = accelerometer.specific_force_mps2[i];
    values = record.others.find(column)->second;
    std::size_t at = 0;
    const auto bridged = bridge_gaps(values, at);
    if (!bridged) complain_of_gap(record, column, at);
    accelerometer.bridged = std::max(accelerometer.bridged, *bridged);
    for (double& value : values) value *= unit->mps2;
  }
  return accelerometer;
}

}  // namespace gyrod::files
