/// Reads a recording row by row: plain or gzip by content, in constant memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/line_reader.hpp"
#include "files/recording_header.hpp"
#include "stream/sample.hpp"

namespace gyrod::files {

struct ReaderOptions {
  /// Sample rate for made-up stamps where the file has no time column, Hz, above 0. Default: the common rate
  /// of MEMS recordings.
  double nominal_rate_hz = 100.0;
  /// Take a file without one or two of the axes (a yaw-rate sensor); the missing rates are 0. By default an
  /// error, since a misspelt column must not read as a sensor at rest.
  bool allow_missing_axes = false;
  /// Read the accelerometer's columns, too: text there that is no number makes a broken row, and its being absent is an error. An empty
  /// cell, nan and inf read as nan.
  bool accelerometer = false;
  /// Count broken rows and go on. By default the first one is an error.
  bool skip_broken_rows = false;
};

struct RecordingRow {
  stream::Sample sample;
  /// The row as it stands in the file, for RecordingWriter; move it out at will.
  std::string text;
  /// Line in the file, counted from 1 (the header).
  std::uint64_t line = 0;
};

/// Rates are converted to rad/s. An empty cell, nan and inf are legal rates (the engine refuses and counts
/// them); text that is no number, a missing or an extra cell make a broken row, as do a time or a sequence
/// number that cannot be read. Stamps are exact to the nanosecond: decimal text is converted without passing
/// through a double. Blank lines are skipped. A quoted cell may hold separators but no line end. One thread
/// at a time.
class RecordingReader {
 public:
  /// @param path file, or "-" for standard input
  /// @throws FileError as LineReader and recognise_columns do, and for an empty file
  explicit RecordingReader(const std::string& path, const ReaderOptions& options = {});
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;

  /// Reads the next row into `row`, whose memory is used again.
  /// @return false at the end of the file
  /// @throws FileError for a broken row (file:line, column, text, what was expected), a damaged file, a file
  /// without rows
  [[nodiscard]] bool next(RecordingRow& row);

  [[nodiscard]] const RecordingHeader& header() const noexcept { return header_; }
  /// The file has no time column: stamps are sequence / nominal_rate_hz from 0.
  [[nodiscard]] bool stamps_made_up() const noexcept { return !header_.time; }
  /// Rows given out, and broken ones skipped.
  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }
  [[nodiscard]] std::uint64_t broken_rows() const noexcept { return broken_rows_; }
  /// Part of the file that has been read, 0..1; nothing for standard input.
  [[nodiscard]] std::optional<double> progress() const noexcept { return lines_.progress(); }

 private:
  /// Fills row.sample from row.text. @return what is wrong with the row, or nothing
  [[nodiscard]] std::optional<std::string> parse(RecordingRow& row);
  [[nodiscard]] std::optional<std::string> parse_rates(stream::Sample& sample) const;
  [[nodiscard]] std::optional<std::string> parse_accelerometer(stream::Sample& sample) const;
  [[nodiscard]] std::optional<std::string> parse_sequence_and_stamp(stream::Sample& sample) const;
  [[nodiscard]] std::string complaint(std::size_t column, std::string_view expected) const;

  ReaderOptions options_;
  LineReader lines_;
  RecordingHeader header_;
  std::vector<std::string_view> names_;  ///< cells of header_.text
  std::vector<std::string_view> cells_;  ///< cells of the row in hand
  std::uint64_t rows_ = 0;
  std::uint64_t broken_rows_ = 0;
};

}  // namespace gyrod::files
