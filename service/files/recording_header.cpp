#include "files/recording_header.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "files/accelerometer_units.hpp"
#include "files/csv_row.hpp"
#include "files/file_error.hpp"

namespace gyrod::files {
namespace {

constexpr std::array<char, stream::kAxes> kAxisNames = {'x', 'y', 'z'};

struct TimeName {
  std::string_view name;
  int exponent;
};
/// Best first.
constexpr std::array<TimeName, 12> kTimeNames = {{{"stamp_ns", 0},
                                                  {"timestamp_ns", 0},
                                                  {"time_ns", 0},
                                                  {"stamp_us", 3},
                                                  {"timestamp_us", 3},
                                                  {"time_us", 3},
                                                  {"stamp_ms", 6},
                                                  {"timestamp_ms", 6},
                                                  {"time_ms", 6},
                                                  {"stamp_s", 9},
                                                  {"timestamp_s", 9},
                                                  {"time_s", 9}}};
/// Best first.
constexpr std::array<std::string_view, 2> kSequenceNames = {"sequence", "sample"};

char to_lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The names in lower case, without blanks and quotes.
using Names = std::vector<std::string>;

char most_frequent_separator(std::string_view text) noexcept {
  const auto count = [text](char c) { return std::ranges::count(text, c); };
  constexpr std::array<char, 3> kSeparators = {',', ';', '\t'};
  return *std::ranges::max_element(kSeparators, {}, count);
}

Names names_of(std::string_view text, char separator, std::string_view file_name) {
  std::vector<std::string_view> cells;
  const bool is_text = text.find('\0') == std::string_view::npos;
  if (!is_text || !split_row(text, separator, cells)) {
    throw FileError(std::string(file_name) + ":1: expected a header line of comma-separated text, found " +
                    shown(text));
  }
  Names names;
  for (const auto cell : cells) {
    names.emplace_back(bare(cell));
    std::ranges::transform(names.back(), names.back().begin(), to_lower);
  }
  return names;
}

std::optional<std::size_t> find_column(const Names& names, std::string_view name) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

void find_accelerometer(const Names& names, RecordingHeader& header) {
  for (const AccelUnit& unit : kAccelUnits) {
    const auto x = find_column(names, accel_column(0, unit));
    const auto y = find_column(names, accel_column(1, unit));
    const auto z = find_column(names, accel_column(2, unit));
    if (!x || !y || !z) continue;
    header.accelerometer = {*x, *y, *z};
    header.accelerometer_unit_mps2 = unit.mps2;
    return;
  }
}

/// Finds the rate columns of one header and their unit.
class GyroColumns {
 public:
  GyroColumns(const Names& names, std::string_view file_name) : names_(names), file_name_(file_name) {}

  void find(RecordingHeader& header, bool allow_missing_axes) {
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      header.gyro[axis] = column_of(axis);
      if (header.gyro[axis]) ++found;
    }
    if (found == 0)
      fail("no angular rate: expected gyro_x_UNIT, gyro_y_UNIT, gyro_z_UNIT with UNIT one of " +
           known_rate_units() + "; found " + all_names());
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      if (!header.gyro[axis] && !allow_missing_axes) {
        fail("no column for the angular rate about " + std::string(1, kAxisNames[axis]) + ": expected " +
             prefix(axis) + std::string(spelling_of(*unit_)) + "; found " + all_names());
      }
    }
    header.unit = *unit_;
  }

 private:
  static std::string prefix(std::size_t axis) { return std::string("gyro_") + kAxisNames[axis] + "_"; }

  std::optional<std::size_t> column_of(std::size_t axis) {
    std::optional<std::size_t> column;
    std::optional<std::size_t> unknown;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (!names_[i].starts_with(prefix(axis)) && names_[i] + "_" != prefix(axis)) continue;
      const auto unit = unit_in(i, axis);
      if (!unit) unknown = i;
      if (!unit) continue;
      if (column) fail("two columns for one axis: " + shown(names_[*column]) + " and " + shown(names_[i]));
      column = i;
      take_unit(*unit, i);
    }
    if (!column && unknown)
      fail("column " + shown(names_[*unknown]) + " has " + unknown_unit(*unknown, axis) +
           "; known units: " + known_rate_units());
    return column;
  }

  [[nodiscard]] std::string_view unit_text(std::size_t column, std::size_t axis) const {
    return std::string_view(names_[column]).substr(std::min(prefix(axis).size(), names_[column].size()));
  }

  [[nodiscard]] std::optional<RateUnit> unit_in(std::size_t column, std::size_t axis) const {
    return rate_unit_of(unit_text(column, axis));
  }

  [[nodiscard]] std::string unknown_unit(std::size_t column, std::size_t axis) const {
    const auto text = unit_text(column, axis);
    return text.empty() ? "no unit" : "the unknown unit " + shown(text);
  }

  void take_unit(RateUnit unit, std::size_t column) {
    if (unit_ && *unit_ != unit) {
      fail("column " + shown(names_[column]) + " is in " + std::string(spelling_of(unit)) +
           ", another axis in " + std::string(spelling_of(*unit_)) + ": expected one unit for all axes");
    }
    unit_ = unit;
  }

  [[nodiscard]] std::string all_names() const {
    std::string list;
    for (const auto& name : names_) list += list.empty() ? name : ", " + name;
    return shown(list);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(std::string(file_name_) + ":1: " + what);
  }

  const Names& names_;
  std::string_view file_name_;
  std::optional<RateUnit> unit_;
};

}  // namespace

RecordingHeader recognise_columns(std::string_view text, std::string_view file_name,
                                  bool allow_missing_axes) {
  RecordingHeader header;
  header.text = text;
  header.separator = most_frequent_separator(text);
  const Names names = names_of(text, header.separator, file_name);
  header.columns = names.size();
  GyroColumns(names, file_name).find(header, allow_missing_axes);
  find_accelerometer(names, header);
  for (const auto& [name, exponent] : kTimeNames) {
    if (header.time) break;
    header.time = find_column(names, name);
    header.time_exponent = exponent;
  }
  for (const auto name : kSequenceNames) {
    if (!header.sequence) header.sequence = find_column(names, name);
  }
  return header;
}

}  // namespace gyrod::files
