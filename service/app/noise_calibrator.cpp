#include "app/noise_calibrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/angle_units.hpp"
#include "core/noise/noise_units.hpp"
#include "core/noise/still_noise.hpp"
#include "core/signal/moments.hpp"
#include "files/file_error.hpp"
#include "files/navigation_columns.hpp"

namespace gyrod::app {
namespace {

using Samples = std::span<const double>;
using core::RestVerdict;

constexpr double kSqrtSecondsPerSqrtHour = 60.0;
/// Stretches that are named one by one.
constexpr std::size_t kNamedStretches = 5;

/// The part of the recording between from and to.
struct Part {
  std::size_t first = 0;
  std::size_t size = 0;
};

Part part_of(const files::Record& record, const CalibrationOptions& options) {
  const auto begin = std::ranges::lower_bound(record.time_s, options.from_s);
  const auto end = std::ranges::upper_bound(record.time_s, options.to_s);
  if (begin >= end) {
    const std::string to = options.to_s < record.time_s.back() ? fmt::format(" to {:g} s", options.to_s) : "";
    throw files::FileError(
        fmt::format("{}: nothing from {:g} s{}; expected times within the {:.1f} s of the recording{}",
                    record.name, options.from_s, to, record.time_s.back(),
                    record.counts.gaps > 0 ? ", its longest stretch without a long gap" : ""));
  }
  return {.first = static_cast<std::size_t>(begin - record.time_s.begin()),
          .size = static_cast<std::size_t>(end - begin)};
}

bool has_accelerometer(const files::Record& record) {
  return std::ranges::any_of(record.others,
                             [](const auto& column) { return column.first.starts_with("accel_x_"); });
}

/// What the recording has of an accelerometer, or why it cannot be used.
struct Forces {
  std::optional<files::Accelerometer> accelerometer;
  std::string trouble;
};

Forces forces_of(const files::Record& record) {
  if (!has_accelerometer(record)) return {};
  try {
    return {files::accelerometer_of(record), ""};
  } catch (const files::FileError& error) {
    return {std::nullopt, error.what()};
  }
}

/// Axes of the part; a missing axis counts as 0, which is an axis that never changes.
core::StillSearch search(const files::Record& record, Part part, const Forces& forces,
                         const std::function<bool(double)>& go_on) {
  const std::vector<double> absent(part.size, 0.0);
  core::StillInput input;
  for (std::size_t a = 0; a < input.rate.size(); ++a) {
    const std::vector<double>& axis = record.gyro_radps[a];
    input.rate[a] = axis.empty() ? Samples(absent) : Samples(axis).subspan(part.first, part.size);
  }
  if (forces.accelerometer) {
    for (std::size_t a = 0; a < input.accelerometer.size(); ++a) {
      const Samples axis = forces.accelerometer->specific_force_mps2[a];
      input.accelerometer[a] = axis.subspan(part.first, part.size);
    }
  }
  if (!record.bridged.empty()) input.bridged = std::span(record.bridged).subspan(part.first, part.size);
  bool stopped = false;
  core::StillSearch found = core::find_still(input, record.sample_rate_hz, [&](double done) {
    stopped = !go_on(done);
    return !stopped;
  });
  if (stopped) throw files::Stopped{};
  return found;
}

std::string excuse(const core::StillSearch& found, double rate, bool any_bridged) {
  const auto seconds = [&](RestVerdict verdict) {
    return static_cast<double>(found.verdicts[static_cast<std::size_t>(verdict)]) / rate;
  };
  std::string text;
  const auto add = [&text](double s, const char* what) {
    if (s >= 0.5) text += fmt::format("{}{:.1f} s {}", text.empty() ? "" : ", ", s, what);
  };
  add(seconds(RestVerdict::kUneven), "change in level");
  add(seconds(RestVerdict::kWandering), "turn slowly");
  add(seconds(RestVerdict::kTone), "hold a tone (an engine, a fan)");
  add(seconds(RestVerdict::kFrozen), "do not change at all");
  if (any_bridged)
    add(seconds(RestVerdict::kTooEarly), "are too near to bridged samples, more than 2 in a hundred");
  add(static_cast<double>(found.turning) / rate, "turn steadily");
  add(static_cast<double>(found.stuck) / rate, "have an axis that is stuck");
  add(static_cast<double>(found.louder) / rate, "are steady, but louder than the quietest part");
  return text.empty() ? "" : "; of the rest " + text;
}

void require_enough(const NoiseCalibrationRun& run, const files::Record& record,
                    const CalibrationOptions& options) {
  const double rate = record.sample_rate_hz;
  const double still_s = static_cast<double>(run.found.still) / rate;
  if (still_s >= options.least_still_s && run.found.still >= core::kMinStillSamples) return;
  const double needed_s = std::max(options.least_still_s, static_cast<double>(core::kMinStillSamples) / rate);
  const double all_s = static_cast<double>(run.samples) / rate;
  std::string text =
      fmt::format("{}: {:.1f} s of {:.1f} s are at rest{}; expected {:g} s at least", record.name, still_s,
                  all_s, excuse(run.found, rate, !record.bridged.empty()), needed_s);
  if (!options.all_still && all_s >= needed_s) text += ". --all-still takes all of it as still";
  throw files::FileError(text);
}

/// What axes share is taken for the sensor's, too.
std::array<core::StillAxis, 3> axis_by_axis(const std::vector<core::AxisSamples>& still) {
  std::array<core::StillAxis, 3> axes;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    std::vector<Samples> alone;
    for (const core::AxisSamples& stretch : still) alone.push_back(stretch[a]);
    axes[a].model = core::still_noise(alone);
  }
  return axes;
}

/// @param whole on the user's word
void fit_axes(const files::Record& record, bool whole, NoiseCalibrationRun& run) {
  std::vector<core::AxisSamples> still;
  for (const core::Stretch& stretch : run.found.stretches) {
    core::AxisSamples& axes = still.emplace_back();
    for (std::size_t a = 0; a < axes.size(); ++a) {
      if (!record.gyro_radps[a].empty())
        axes[a] = Samples(record.gyro_radps[a]).subspan(stretch.first, stretch.size);
    }
  }
  run.axes = whole ? axis_by_axis(still) : core::still_noise(still);
  bool any = false;
  for (std::size_t a = 0; a < record.gyro_radps.size(); ++a) {
    if (record.gyro_radps[a].empty()) continue;
    double sum = 0.0;
    for (const core::AxisSamples& stretch : still)
      sum += core::mean(stretch[a]) * static_cast<double>(stretch[a].size());
    if (!run.axes[a].model) continue;
    any = true;
    run.calibration.models[a] = *run.axes[a].model;
    run.calibration.bias_radps[a] = sum / static_cast<double>(run.found.still);
  }
  if (!any) throw files::FileError(record.name + ": no axis changes; expected the noise of a sensor");
}

}  // namespace

NoiseCalibrationRun calibrate_noise(const files::Record& record, const CalibrationOptions& options,
                                    const std::function<bool(double done)>& go_on) {
  const Part part = part_of(record, options);
  NoiseCalibrationRun run;
  run.samples = part.size;
  run.any_bridged = !record.bridged.empty();
  run.first_s = record.time_s[part.first];
  if (options.all_still) {
    run.found.stretches = {{0, part.size}};
    run.found.still = part.size;
  } else {
    const Forces forces = forces_of(record);
    run.with_accelerometer = forces.accelerometer.has_value();
    run.accelerometer_trouble = forces.trouble;
    run.found = search(record, part, forces, go_on);
  }
  for (core::Stretch& stretch : run.found.stretches) stretch.first += part.first;
  require_enough(run, record, options);
  settings::NoiseCalibration& calibration = run.calibration;
  if (!options.sensor_id.empty()) calibration.sensor_id = options.sensor_id;
  calibration.sample_rate_hz = record.sample_rate_hz;
  calibration.origin = {.source = std::filesystem::path(record.name).filename().string(),
                        .first_stamp_s = record.first_stamp_s,
                        .still_s = static_cast<double>(run.found.still) / record.sample_rate_hz};
  fit_axes(record, options.all_still, run);
  return run;
}

std::string calibration_table(const settings::NoiseCalibration& calibration) {
  std::string text =
      fmt::format("{:<4} {:>10} {:>10} {:>14} {:>12} {:>12}\n{:<4} {:>10} {:>10} {:>14} {:>12} {:>12}\n",
                  "axis", "bias", "std", "noise density", "ARW", "lag-1", "", "deg/s", "deg/s",
                  "deg/s/sqrt(Hz)", "deg/sqrt(h)", "correlation");
  const double rate = calibration.sample_rate_hz;
  const bool measured = calibration.origin.still_s.has_value();
  for (std::size_t a = 0; a < calibration.models.size(); ++a) {
    const core::NoiseModel& model = calibration.models[a];
    if (!core::is_usable(model)) {
      text += fmt::format("{:<4} no noise: not there, or never changes\n", "xyz"[a]);
      continue;
    }
    const std::string bias =
        measured ? fmt::format("{:.4f}", calibration.bias_radps[a] * kDegPerRad) : std::string("-");
    text += fmt::format("{:<4} {:>10} {:>10.4f} {:>14.5f} {:>12.3f} {:>12.2f}\n", "xyz"[a], bias,
                        std::sqrt(core::noise_variance(model)) * kDegPerRad,
                        core::noise_density(model, rate) * kDegPerRad,
                        core::angle_random_walk(model, rate) * kDegPerRad * kSqrtSecondsPerSqrtHour,
                        core::lag_one_correlation(model));
  }
  for (std::size_t a = 0; a < calibration.models.size(); ++a) {
    for (const core::SpectralLine& line : calibration.models[a].lines()) {
      text += fmt::format("{} has a narrow line at {:.4g} Hz: {:.4f} deg/s, {:.0f} % of its noise's power\n",
                          "xyz"[a], line.cycles * rate, std::sqrt(line.variance) * kDegPerRad,
                          100.0 * line.variance / core::noise_variance(calibration.models[a]));
    }
  }
  return text;
}

std::string shared_lines_text(const NoiseCalibrationRun& run) {
  constexpr double kSameLine = 0.02;
  struct Named {
    double cycles;
    std::string levels;
  };
  std::vector<Named> lines;
  for (std::size_t a = 0; a < run.axes.size(); ++a) {
    for (const core::SpectralLine& line : std::span(run.axes[a].shared).first(run.axes[a].shared_count)) {
      const std::string level =
          fmt::format("{} {:.4f} deg/s", "xyz"[a], std::sqrt(line.variance) * kDegPerRad);
      const auto same = std::ranges::find_if(lines, [&line](const Named& named) {
        return std::abs(named.cycles - line.cycles) < kSameLine * line.cycles;
      });
      if (same == lines.end())
        lines.push_back({line.cycles, level});
      else
        same->levels += ", " + level;
    }
  }
  std::string text;
  for (const Named& line : lines) {
    text += fmt::format(
        "  axes share a line at {:.4g} Hz ({}): an engine or a fan, left out of the noise; --all-still takes "
        "it for the sensor's\n",
        line.cycles * run.calibration.sample_rate_hz, line.levels);
  }
  return text;
}

std::string stretches_text(const NoiseCalibrationRun& run) {
  const double rate = run.calibration.sample_rate_hz;
  const auto seconds = [rate](std::size_t samples) { return static_cast<double>(samples) / rate; };
  const auto& stretches = run.found.stretches;
  std::string text =
      fmt::format("{}: {:.1f} s of {:.1f} s at rest, {:g} Hz{}\n", run.calibration.origin.source,
                  seconds(run.found.still), seconds(run.samples), rate,
                  run.with_accelerometer ? ", by gyro and accelerometer" : "");
  if (run.found.still == run.samples) return text;
  for (std::size_t i = 0; i < std::min(stretches.size(), kNamedStretches); ++i) {
    text += fmt::format("  still from {:.1f} s to {:.1f} s\n", seconds(stretches[i].first),
                        seconds(stretches[i].first + stretches[i].size));
  }
  if (stretches.size() > kNamedStretches)
    text += fmt::format("  and {} more stretches\n", stretches.size() - kNamedStretches);
  const std::string rest = excuse(run.found, rate, run.any_bridged);
  if (!rest.empty()) text += "  " + rest.substr(2) + "\n";
  return text;
}

}  // namespace gyrod::app
