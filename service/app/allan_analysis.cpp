#include "app/allan_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "core/signal/interpolation.hpp"
#include "core/signal/moments.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

constexpr std::size_t kFewestSamples = 3;
constexpr std::size_t kMaxBridged = 16;
constexpr std::string_view kAxisLetters = "xyz";

struct AccelerationUnit {
  const char* suffix;
  double mps2;
};
constexpr double kStandardGravity = 9.80665;  // by definition
constexpr std::array<AccelerationUnit, 3> kAccelerationUnits = {
    {{"_mps2", 1.0}, {"_g", kStandardGravity}, {"_mg", 1e-3 * kStandardGravity}}};

/// Fills runs of NaN between numbers by straight lines.
/// @return nothing if a run is too long, or at an end
std::optional<std::vector<double>> bridged(std::vector<double> values) {
  std::size_t n = 0;
  while (n < values.size()) {
    if (!std::isnan(values[n])) {
      ++n;
      continue;
    }
    std::size_t end = n;
    while (end < values.size() && std::isnan(values[end])) ++end;
    const std::size_t count = end - n;
    if (n == 0 || end == values.size() || count > kMaxBridged) return std::nullopt;
    for (std::size_t step = 0; step < count; ++step) {
      values[n + step] = core::bridge(values[n - 1], values[end], step, count);
    }
    n = end;
  }
  return values;
}

/// Samples of a channel in SI units.
struct Source {
  SensorKind sensor = SensorKind::kGyro;
  char axis = 'x';
  std::vector<double> samples;
};

std::optional<Source> accelerometer(const files::Record& record, char axis, std::vector<std::string>& notes) {
  for (const AccelerationUnit& unit : kAccelerationUnits) {
    const std::string name = std::string("accel_") + axis + unit.suffix;
    const auto column = record.others.find(name);
    if (column == record.others.end()) continue;
    auto samples = bridged(column->second);
    if (!samples || !std::ranges::all_of(*samples, [](double value) { return std::isfinite(value); })) {
      notes.push_back(name + " is left out: cells without a number at an end, or more than " +
                      std::to_string(kMaxBridged) + " in a row");
      return std::nullopt;
    }
    for (double& value : *samples) value *= unit.mps2;
    return Source{SensorKind::kAccelerometer, axis, std::move(*samples)};
  }
  return std::nullopt;
}

std::vector<Source> sources_of(const files::Record& record, std::string_view axes,
                               std::vector<std::string>& notes) {
  std::vector<Source> sources;
  for (const char axis : axes) {
    const std::vector<double>& rate = record.gyro_radps[kAxisLetters.find(axis)];
    if (rate.empty()) {
      throw files::FileError(record.name + ": has no column gyro_" + axis +
                             "_UNIT; choose other axes (--axis)");
    }
    sources.push_back({SensorKind::kGyro, axis, rate});
  }
  for (const char axis : axes) {
    if (auto source = accelerometer(record, axis, notes)) sources.push_back(std::move(*source));
  }
  return sources;
}

AllanChannel analyse(const Source& source, double sample_rate_hz, const core::AllanOptions& options) {
  AllanChannel channel;
  channel.sensor = source.sensor;
  channel.axis = source.axis;
  channel.mean = core::mean(source.samples);
  channel.points = core::allan_deviation(source.samples, sample_rate_hz, options);
  channel.fit = core::fit_coefficients(channel.points);
  channel.slopes = core::slope_coefficients(channel.points);
  channel.polynomial = core::polynomial_coefficients(channel.points);
  return channel;
}

}  // namespace

std::string AllanChannel::name() const {
  return (sensor == SensorKind::kGyro ? "gyro_" : "accel_") + std::string(1, axis);
}

AllanAnalysis analyse_allan(const files::Record& record, std::string_view axes,
                            const core::AllanOptions& options, const std::function<bool(double)>& go_on) {
  if (record.size() < kFewestSamples) {
    throw files::FileError(record.name + ": " + std::to_string(record.size()) +
                           " good samples in a row; an Allan deviation needs at least " +
                           std::to_string(kFewestSamples));
  }
  AllanAnalysis analysis;
  analysis.input = record.name;
  analysis.sample_rate_hz = record.sample_rate_hz;
  analysis.rate_given = record.rate_given;
  analysis.samples = record.size();
  analysis.rows = record.counts;
  analysis.options = options;
  const std::vector<Source> sources = sources_of(record, axes, analysis.notes);
  for (const Source& source : sources) {
    const auto done = static_cast<double>(analysis.channels.size());
    if (!go_on(done / static_cast<double>(sources.size()))) break;
    analysis.channels.push_back(analyse(source, record.sample_rate_hz, options));
  }
  return analysis;
}

}  // namespace gyrod::app
