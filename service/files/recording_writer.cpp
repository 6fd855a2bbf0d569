#include "files/recording_writer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "files/csv_row.hpp"
#include "files/file_error.hpp"
#include "files/number_text.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::files {

namespace {

/// ";gyro_std_x_dps;gyro_std_y_dps;gyro_std_z_dps", of the axes that there are.
std::string deviation_columns(const RecordingHeader& header) {
  std::string names;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    if (!header.gyro[axis]) continue;
    const std::string name = std::string("gyro_std_") + "xyz"[axis] + "_";
    if (header.text.find(name) != std::string::npos)
      throw FileError("the recording has a column " + name + "... already; expected one without deviations");
    names.append(1, header.separator).append(name).append(spelling_of(header.unit));
  }
  return names;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::string& path, RecordingHeader header, bool with_deviation)
    : file_(path), header_(std::move(header)), with_deviation_(with_deviation) {
  file_.write(header_.text + (with_deviation_ ? deviation_columns(header_) : "") + "\n");
}

void RecordingWriter::write(std::string_view row_text, const std::array<double, stream::kAxes>& rate_radps,
                            const std::array<double, stream::kAxes>& rate_std_radps) {
  [[maybe_unused]] const bool good = split_row(row_text, header_.separator, cells_);
  assert(good && cells_.size() == header_.columns);
  line_.clear();
  for (std::size_t column = 0; column < cells_.size(); ++column) {
    if (column > 0) line_ += header_.separator;
    const auto axis = std::ranges::find(header_.gyro, column);
    if (axis == header_.gyro.end()) {
      line_ += cells_[column];
    } else {
      append_number(
          line_, from_radps(rate_radps[static_cast<std::size_t>(axis - header_.gyro.begin())], header_.unit));
    }
  }
  if (with_deviation_) append_deviation(rate_std_radps);
  line_ += '\n';
  file_.write(line_);
  ++rows_;
}

void RecordingWriter::append_deviation(const std::array<double, stream::kAxes>& rate_std_radps) {
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    if (!header_.gyro[axis]) continue;
    line_ += header_.separator;
    append_number(line_, from_radps(rate_std_radps[axis], header_.unit));
  }
}

void RecordingWriter::write_unchanged(std::string_view row_text) {
  line_.assign(row_text);
  const auto axes =
      std::ranges::count_if(header_.gyro, [](const auto& column) { return column.has_value(); });
  if (with_deviation_) line_.append(static_cast<std::size_t>(axes), header_.separator);
  line_ += '\n';
  file_.write(line_);
  ++rows_;
}

}  // namespace gyrod::files
