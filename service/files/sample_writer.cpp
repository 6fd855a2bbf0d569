#include "files/sample_writer.hpp"

#include <cassert>

#include "files/number_text.hpp"

namespace gyrod::files {
namespace {

/// ",prefix_x_unit,prefix_y_unit,prefix_z_unit"
std::string axis_columns(std::string_view prefix, RateUnit unit) {
  std::string names;
  for (const char axis : {'x', 'y', 'z'}) {
    names.append(",").append(prefix).append("_").append(1, axis).append("_").append(spelling_of(unit));
  }
  return names;
}

std::string header_of(RowKind kind, RateUnit unit) {
  std::string header = "sensor,sequence,stamp_ns" + axis_columns("gyro", unit);
  if (kind == RowKind::kDenoised) {
    header += axis_columns("gyro_std", unit) + ",flags,noise_source" + axis_columns("noise_floor", unit) +
              ",model_epoch";
  }
  if (kind == RowKind::kSimulated) header += axis_columns("truth", unit);
  return header + "\n";
}

/// Quotes the name if it would not read back as one cell.
void append_name(std::string& line, std::string_view name) {
  if (name.find_first_of(",\"\r\n ;\t") == std::string_view::npos) {
    line += name;
    return;
  }
  line += '"';
  for (const char c : name) line.append(c == '"' ? 2 : 1, c);
  line += '"';
}

}  // namespace

SampleWriter::SampleWriter(const std::string& path, RowKind kind, RateUnit unit)
    : file_(path), kind_(kind), unit_(unit) {
  file_.write(header_of(kind, unit));
}

void SampleWriter::write_measured(std::string_view sensor, const stream::Sample& sample) {
  assert(kind_ == RowKind::kMeasured);
  begin_row(sensor, sample.sequence, sample.stamp_ns, sample.rate_radps);
  end_row();
}

void SampleWriter::write_denoised(std::string_view sensor, const stream::DenoisedSample& sample) {
  assert(kind_ == RowKind::kDenoised);
  begin_row(sensor, sample.sequence, sample.stamp_ns, sample.rate_radps);
  append_rates(sample.rate_std_radps);
  line_ += ',';
  append_number(line_, std::uint64_t{sample.flags});
  line_ += ',';
  append_number(line_, static_cast<std::uint64_t>(sample.noise_source));
  append_rates(sample.noise_floor_radps);
  line_ += ',';
  append_number(line_, sample.model_epoch);
  end_row();
}

void SampleWriter::write_simulated(std::string_view sensor, const stream::Sample& sample,
                                   const std::array<double, stream::kAxes>& truth_radps) {
  assert(kind_ == RowKind::kSimulated);
  begin_row(sensor, sample.sequence, sample.stamp_ns, sample.rate_radps);
  append_rates(truth_radps);
  end_row();
}

void SampleWriter::begin_row(std::string_view sensor, std::uint64_t sequence, std::int64_t stamp_ns,
                             const std::array<double, stream::kAxes>& rate_radps) {
  line_.clear();
  append_name(line_, sensor);
  line_ += ',';
  append_number(line_, sequence);
  line_ += ',';
  append_number(line_, stamp_ns);
  append_rates(rate_radps);
}

void SampleWriter::append_rates(const std::array<double, stream::kAxes>& rate_radps) {
  for (const double rate : rate_radps) {
    line_ += ',';
    append_number(line_, from_radps(rate, unit_));
  }
}

void SampleWriter::end_row() {
  line_ += '\n';
  file_.write(line_);
  ++rows_;
}

}  // namespace gyrod::files
