#include "files/recording_writer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "files/csv_row.hpp"
#include "files/number_text.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::files {

RecordingWriter::RecordingWriter(const std::string& path, RecordingHeader header)
    : file_(path), header_(std::move(header)) {
  file_.write(header_.text + "\n");
}

void RecordingWriter::write(std::string_view row_text, const std::array<double, stream::kAxes>& rate_radps) {
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
  line_ += '\n';
  file_.write(line_);
  ++rows_;
}

void RecordingWriter::write_unchanged(std::string_view row_text) {
  line_.assign(row_text);
  line_ += '\n';
  file_.write(line_);
  ++rows_;
}

}  // namespace gyrod::files
