/// A recording in memory, uniformly sampled: what Allan deviation, navigation and the report work on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "files/recording_header.hpp"
#include "files/recording_reader.hpp"
#include "stream/sample.hpp"

namespace gyrod::files {

struct RecordOptions {
  /// How rows are read; its nominal_rate_hz is not used here.
  ReaderOptions reader;
  /// Hz, above 0. Nothing: from the stamps, and a file without a time column is an error. Given: it holds,
  /// whatever the stamps say.
  std::optional<double> sample_rate_hz;
  /// Hz, above 0: taken where no rate is given and the file has no time column.
  std::optional<double> assumed_rate_hz;
  /// Missing or refused samples in a row that are bridged by a straight line; more of them end a stretch.
  std::uint64_t max_bridged_samples = 16;
  /// A rate beyond this is refused, rad/s.
  double max_rate_radps = 175.0;
  /// Keep the columns that are neither rate, time nor number.
  bool other_columns = false;
  /// Called now and then with the part of the file that has been read, 0..1, or nothing where that is not known,
  /// and the rows so far. Empty: nobody looks. @return false to stop reading: load_record() then throws Stopped
  std::function<bool(std::optional<double> fraction, std::uint64_t rows)> progress;
};

/// The longest stretch of a recording without a long gap. All columns have size() elements.
struct Record {
  /// What became of the rows; received = size - bridged + refused + left_out.
  struct Counts {
    std::uint64_t rows = 0;      ///< that could be read
    std::uint64_t broken = 0;    ///< left out, see ReaderOptions::skip_broken_rows
    std::uint64_t refused = 0;   ///< not finite, out of range, duplicate, out of order
    std::uint64_t missing = 0;   ///< never there, by number or by time, within the stretch
    std::uint64_t bridged = 0;   ///< samples made by bridging, within the stretch
    std::uint64_t gaps = 0;      ///< places too long to bridge: stretches - 1
    std::uint64_t left_out = 0;  ///< good samples of the other stretches
  };

  std::string name;        ///< of the file, for messages
  RecordingHeader header;  ///< of the file
  double sample_rate_hz = 0.0;
  bool rate_given = false;    ///< by the user; else the mean rate of the stamps
  bool rate_assumed = false;  ///< it is RecordOptions::assumed_rate_hz
  std::vector<double>
      time_s;  ///< since the first sample of the stretch, by stamps (by rate where there are none)
  double first_stamp_s = 0.0;  ///< of the first sample of the stretch, on the file's own clock
  /// Finite; empty for an axis that the file does not have.
  std::array<std::vector<double>, stream::kAxes> gyro_radps;
  /// 1 where a sample was bridged, else 0; empty where none was.
  std::vector<std::uint8_t> bridged;
  /// Other columns that hold a number somewhere, by name in lower case; NaN where the cell is no number and at
  /// bridged samples. In the file's unit.
  std::map<std::string, std::vector<double>, std::less<>> others;
  Counts counts;

  [[nodiscard]] std::size_t size() const noexcept { return time_s.size(); }
};

/// Reading was stopped by RecordOptions::progress.
struct Stopped {};

/// Samples are judged as the daemon judges them (stream::SampleGate).
/// @param path file, or "-" for standard input
/// @throws FileError as RecordingReader does; for a file without time column where no rate is given; for stamps
/// that do not go on; if not one sample is good
/// @throws Stopped
[[nodiscard]] Record load_record(const std::string& path, const RecordOptions& options);

}  // namespace gyrod::files
