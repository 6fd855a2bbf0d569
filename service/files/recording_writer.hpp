/// Writes a recording like the one it came from: same columns, same units, other angular rates.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "files/output_file.hpp"
#include "files/recording_header.hpp"
#include "stream/sample.hpp"

namespace gyrod::files {

/// The header and all cells but the angular rates go through verbatim. Rates are written in the header's
/// unit, as the shortest decimal that reads back to the same double. Lines end in LF. One thread at a time.
///
///     RecordingReader reader(in);
///     RecordingWriter writer(out, reader.header());
///     while (reader.next(row)) writer.write(row.text, denoised(row.sample.rate_radps));
///     writer.close();   // without it nothing is left of the output
class RecordingWriter {
 public:
  /// @param with_deviation adds a column gyro_std_x_UNIT for each angular rate (x, y, z), in the same unit, at the end of the row
  /// @throws FileError as OutputFile does, or where the recording has such a column already
  RecordingWriter(const std::string& path, RecordingHeader header, bool with_deviation = false);

  /// @param row_text the row as read (RecordingRow::text), with the header's number of cells
  /// @param rate_radps, rate_std_radps x, y, z; an axis the header does not have is left out, and without the columns the deviation
  void write(std::string_view row_text, const std::array<double, stream::kAxes>& rate_radps,
             const std::array<double, stream::kAxes>& rate_std_radps = {});

  /// Writes the row as it was read: a sample that was refused stays in the recording as it is. Its deviation stays empty.
  void write_unchanged(std::string_view row_text);

  /// See OutputFile::close().
  void close() { file_.close(); }

  [[nodiscard]] std::uint64_t rows() const noexcept { return rows_; }

 private:
  void append_deviation(const std::array<double, stream::kAxes>& rate_std_radps);

  OutputFile file_;
  RecordingHeader header_;
  bool with_deviation_;
  std::vector<std::string_view> cells_;
  std::string line_;
  std::uint64_t rows_ = 0;
};

}  // namespace gyrod::files
