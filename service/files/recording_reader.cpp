#include "files/recording_reader.hpp"

#include <cassert>
#include <cmath>
#include <limits>

#include "files/accelerometer_units.hpp"
#include "files/csv_row.hpp"
#include "files/file_error.hpp"
#include "files/number_text.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::files {
namespace {

constexpr double kNsPerS = 1e9;

RecordingHeader read_header(LineReader& lines, bool allow_missing_axes) {
  std::string_view text;
  if (!lines.next(text)) throw FileError(lines.name() + ": is empty, expected a header line and rows");
  return recognise_columns(text, lines.name(), allow_missing_axes);
}

/// Stamp of a sample that has none, ns; nothing beyond 64 bits.
std::optional<std::int64_t> stamp_of(std::uint64_t sequence, double rate_hz) noexcept {
  const double stamp_ns = std::round(static_cast<double>(sequence) * (kNsPerS / rate_hz));
  constexpr auto kLargest = static_cast<double>(std::numeric_limits<std::int64_t>::max());
  if (!(stamp_ns < kLargest)) return std::nullopt;
  return static_cast<std::int64_t>(stamp_ns);
}

}  // namespace

RecordingReader::RecordingReader(const std::string& path, const ReaderOptions& options)
    : options_(options), lines_(path), header_(read_header(lines_, options.allow_missing_axes)) {
  assert(options.nominal_rate_hz > 0.0);
  [[maybe_unused]] const bool good = split_row(header_.text, header_.separator, names_);
  assert(good);
  if (options.accelerometer && !header_.accelerometer)
    throw FileError(lines_.name() + std::string(kNoAccelerometer) + shown(header_.text));
}

bool RecordingReader::next(RecordingRow& row) {
  std::string_view line;
  while (lines_.next(line)) {
    if (line.find_first_not_of(' ') == std::string_view::npos) continue;
    row.text = line;
    row.line = lines_.line_number();
    const auto wrong = parse(row);
    if (!wrong) {
      ++rows_;
      return true;
    }
    if (!options_.skip_broken_rows)
      throw FileError(lines_.name() + ":" + std::to_string(row.line) + ": " + *wrong);
    ++broken_rows_;
  }
  if (rows_ == 0) {
    throw FileError(lines_.name() +
                    (broken_rows_ == 0 ? ": has a header but no rows" : ": all rows are broken"));
  }
  return false;
}

std::optional<std::string> RecordingReader::parse(RecordingRow& row) {
  if (!split_row(row.text, header_.separator, cells_))
    return "a quoted cell does not end: " + shown(row.text);
  if (cells_.size() != header_.columns) {
    return "expected " + std::to_string(header_.columns) + " cells as in the header, found " +
           std::to_string(cells_.size()) + ": " + shown(row.text);
  }
  if (auto wrong = parse_rates(row.sample)) return wrong;
  if (auto wrong = parse_accelerometer(row.sample)) return wrong;
  return parse_sequence_and_stamp(row.sample);
}

std::optional<std::string> RecordingReader::parse_rates(stream::Sample& sample) const {
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const auto column = header_.gyro[axis];
    const auto value = column ? parse_rate(bare(cells_[*column])) : 0.0;
    if (!value) return complaint(*column, "a number, nan or nothing");
    sample.rate_radps[axis] = to_radps(*value, header_.unit);
  }
  return std::nullopt;
}

std::optional<std::string> RecordingReader::parse_accelerometer(stream::Sample& sample) const {
  if (!options_.accelerometer) return std::nullopt;
  auto& force_mps2 = sample.specific_force_mps2.emplace();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const std::size_t column = (*header_.accelerometer)[axis];
    const auto value = parse_rate(bare(cells_[column]));
    if (!value) return complaint(column, "a number, nan or nothing");
    force_mps2[axis] = *value * header_.accelerometer_unit_mps2;
  }
  return std::nullopt;
}

std::optional<std::string> RecordingReader::parse_sequence_and_stamp(stream::Sample& sample) const {
  const auto sequence =
      header_.sequence ? parse_sequence(bare(cells_[*header_.sequence])) : rows_ + broken_rows_;
  if (!sequence) return complaint(*header_.sequence, "a whole number, 0 or above");
  const auto stamp = header_.time ? parse_stamp_ns(bare(cells_[*header_.time]), header_.time_exponent)
                                  : stamp_of(*sequence, options_.nominal_rate_hz);
  if (!stamp) {
    return header_.time ? complaint(*header_.time, "a time within 292 years of 0")
                        : complaint(*header_.sequence, "a number that stands for less than 292 years");
  }
  sample.sequence = *sequence;
  sample.stamp_ns = *stamp;
  return std::nullopt;
}

std::string RecordingReader::complaint(std::size_t column, std::string_view expected) const {
  return "column " + shown(bare(names_[column])) + ": expected " + std::string(expected) + ", found " +
         shown(bare(cells_[column]));
}

}  // namespace gyrod::files
