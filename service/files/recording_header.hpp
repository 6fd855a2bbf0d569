/// The header line of a recording: which column is which, in what unit.
///
///     gyro_x_UNIT, gyro_y_UNIT, gyro_z_UNIT   angular rate; UNIT as in rate_unit.hpp, one for all three
///     stamp_T | timestamp_T | time_T          time of measurement, T = ns us ms s; of several the finest
///     sequence | sample                       number of the sample, counting up by one
///     accel_x_UNIT, accel_y_UNIT, accel_z_UNIT  specific force; UNIT as in accelerometer_units.hpp, one for all three
///     anything else                           passes through (device_ms, temperature, truth, ...)
///
/// Case and blanks around a name do not matter, names may be quoted. Columns are separated by commas,
/// semicolons or tabs, whichever the header holds most of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "files/rate_unit.hpp"
#include "stream/sample.hpp"

namespace gyrod::files {

struct RecordingHeader {
  /// The header line as it stands in the file, without line end and byte order mark.
  std::string text;
  char separator = ',';
  std::size_t columns = 0;
  RateUnit unit = RateUnit::kRadps;
  /// Column of the rate about x, y, z, counted from 0; nothing for an axis the file does not have.
  std::array<std::optional<std::size_t>, stream::kAxes> gyro;
  /// Columns of the specific force along x, y, z, where all three are there.
  std::optional<std::array<std::size_t, stream::kAxes>> accelerometer;
  double accelerometer_unit_mps2 = 1.0;
  /// Column of the sample's number; where there is none, rows are numbered from 0.
  std::optional<std::size_t> sequence;
  /// Column of the time of measurement; where there is none, stamps are made up from the sequence number.
  std::optional<std::size_t> time;
  /// The time column's unit is 10^time_exponent ns: 0 for ns, 3 for us, 6 for ms, 9 for s.
  int time_exponent = 0;
};

/// Recognises the columns.
/// @param text      first line of the file
/// @param file_name for messages
/// @param allow_missing_axes false: all three axes must be there
/// @throws FileError for: no gyro column (names those found); an axis without a column, unless allowed; a
/// rate column without
///         a known unit and no other for that axis; two columns for one axis; different units; text that is
///         no CSV at all
[[nodiscard]] RecordingHeader recognise_columns(std::string_view text, std::string_view file_name,
                                                bool allow_missing_axes);

}  // namespace gyrod::files
