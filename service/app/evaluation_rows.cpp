#include "app/evaluation_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include <CLI/CLI.hpp>

#include "app/angle_units.hpp"
#include "app/evaluation_series.hpp"
#include "app/evaluation_truth.hpp"
#include "core/joint/noise_tracker.hpp"
#include "files/file_error.hpp"
#include "report/json.hpp"
#include "report/stillness.hpp"

namespace gyrod::app {
namespace {

constexpr std::size_t kFewestOfARow = 100;

files::RecordOptions record_options(const EvaluationInput& input) {
  files::RecordOptions options;
  options.reader.skip_broken_rows = input.skip_broken_rows;
  options.reader.allow_missing_axes = true;
  options.sample_rate_hz = input.rate_hz;
  options.max_rate_radps = input.max_rate_radps;
  options.max_bridged_samples = input.max_bridged_samples;
  options.other_columns = true;
  options.progress = input.progress;
  return options;
}

/// Empty where the record does not have the axis.
std::vector<double> gyro_rates(const files::Record& record, const std::string& axis) {
  std::vector<double> rates = record.gyro_radps[axis_index(axis)];
  const double sign = axis.front() == '-' ? -kDegPerRad : kDegPerRad;
  for (double& value : rates) value *= sign;
  return rates;
}

std::vector<double> gyro_column(const files::Record& record, const std::string& axis) {
  std::vector<double> rates = gyro_rates(record, axis);
  if (rates.empty()) throw files::FileError(record.name + ": has no column gyro_" + axis.back() + "_UNIT");
  return rates;
}

files::Record load_noise(const EvaluationInput& input, double rate_hz) {
  files::RecordOptions options = record_options(input);
  options.other_columns = false;
  options.assumed_rate_hz = rate_hz;  // its samples are then taken one by one
  files::Record noise = files::load_record(input.noise, options);
  constexpr double kAlike = 0.01;
  if (std::abs(noise.sample_rate_hz / rate_hz - 1.0) > kAlike) {
    throw files::FileError(
        noise.name + ": was sampled at " + std::to_string(noise.sample_rate_hz) + " Hz, the signal at " +
        std::to_string(rate_hz) +
        " Hz; nothing is resampled: give --rate HZ to take both sample by sample at that rate");
  }
  if (noise.size() < kFewestOfARow) {
    throw files::FileError(noise.name + ": holds " + std::to_string(noise.size()) +
                           " good samples; expected at least " + std::to_string(kFewestOfARow));
  }
  if (input.noise_start >= noise.size()) {
    throw CLI::ValidationError("--noise-start", std::to_string(input.noise_start) + " is beyond the " +
                                                    std::to_string(noise.size()) + " good samples of " +
                                                    noise.name);
  }
  return noise;
}

/// "2 rows cannot be read and are left out, 3 samples are refused, 5 samples are bridged by straight lines", of what there is any of.
std::string losses_of(const files::Record::Counts& counts) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* one, const char* more) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + (count == 1 ? one : more);
  };
  add(counts.broken, " row cannot be read and is left out", " rows cannot be read and are left out");
  add(counts.refused, " sample is refused (no number, out of range, not in order)",
      " samples are refused (no numbers, out of range, not in order)");
  add(counts.bridged, " sample is bridged by a straight line", " samples are bridged by straight lines");
  return text;
}

/// Whether not all is known of a row's noise from its first window on: for as long as that is so, the daemon asks the sensor's other axes.
bool asks_other_axes(const EvaluationRow& row) {
  return core::belief_in(known_at(row.noise.course, 1)) != core::NoiseBelief::kColour;
}

/// Whether axes of the composite are given noise of one axis.
bool shares_noise(const std::array<std::string, 3>& noise_axes) {
  const auto is_same = [&](std::size_t i, std::size_t j) {
    return noise_axes[i].back() == noise_axes[j].back();
  };
  return is_same(0, 1) || is_same(1, 2) || is_same(2, 0);
}

class RowMaker {
 public:
  explicit RowMaker(const EvaluationInput& input)
      : input_(input), record_(files::load_record(input.recording, record_options(input))) {
    all_.name = record_.name;
    all_.rate_hz = record_.sample_rate_hz;
    all_.samples = record_.size();
    if (record_.size() < kFewestOfARow) {
      throw files::FileError(record_.name + ": holds " + std::to_string(record_.size()) +
                             " good samples in one stretch; expected at least " +
                             std::to_string(kFewestOfARow));
    }
    all_.signal_is_truth = input_.signal_is_truth;
    all_.axes = input_.axes;
    all_.truth_axes = input_.truth_axes;
    all_.noise_axes = input_.noise_axes;
    all_.noise_start = input_.noise_start;
    all_.noise_source = input_.known.source;
    all_.calibration_file = input_.known.calibration_file;
    if (!input_.signal_is_truth) prefix_ = truth_prefix(record_, input_);
    all_.truth_columns = input_.signal_is_truth ? "gyro" : prefix_;
    tell_of_losses(record_, "judged");
  }

  [[nodiscard]] EvaluationRows make() {
    if (input_.noise.empty()) {
      tell_of_calibration({"x", "y", "z"});
      for (const std::string& axis : input_.axes) all_.rows.push_back(measured_row(axis));
      look_beside(0, 1.0, nullptr);
      return std::move(all_);
    }
    const files::Record noise = load_noise(input_, record_.sample_rate_hz);
    all_.noise_name = noise.name;
    tell_of_noise(noise);
    tell_of_calibration(input_.noise_axes);
    for (const auto part : spare(noise.time_s, input_.noise_start, record_.size()))
      all_.spare_samples += part.size();
    for (const double scale : input_.noise_scales) {
      const std::size_t first = all_.rows.size();
      for (const std::string& axis : input_.axes) all_.rows.push_back(composite_row(axis, scale, noise));
      look_beside(first, scale, &noise);
    }
    return std::move(all_);
  }

 private:
  [[nodiscard]] std::vector<double> truth(const std::string& axis) const {
    if (input_.signal_is_truth) return gyro_column(record_, axis);
    return truth_rates(record_, prefix_, input_.truth_axes[axis_index(axis)]);
  }

  [[nodiscard]] EvaluationRow measured_row(const std::string& axis) const {
    EvaluationRow row;
    row.axis = axis;
    row.truth_dps = truth(axis);
    row.noisy_dps = gyro_column(record_, axis);
    row.noise_dps = row.noisy_dps;
    for (std::size_t n = 0; n < row.noise_dps.size(); ++n) row.noise_dps[n] -= row.truth_dps[n];
    row.noise_dps = without_mean(with_gaps_bridged(row.noise_dps));
    row.noise = told_beforehand(input_.known, axis, {}, 1.0, record_.sample_rate_hz);
    limit(row);
    return row;
  }

  [[nodiscard]] EvaluationRow composite_row(const std::string& axis, double scale,
                                            const files::Record& noise) const {
    const std::vector<double> all = gyro_column(noise, input_.noise_axes[axis_index(axis)]);
    EvaluationRow row;
    row.axis = axis;
    row.noise_scale = scale;
    row.truth_dps = truth(axis);
    const std::size_t samples = row.truth_dps.size();
    row.noise_dps = scaled(without_mean(stretch(all, input_.noise_start, samples)), scale);
    row.noise = told_beforehand(input_.known, input_.noise_axes[axis_index(axis)],
                                spare(all, input_.noise_start, samples), scale, record_.sample_rate_hz);
    row.noisy_dps = composite(row.truth_dps, row.noise_dps);
    limit(row);
    return row;
  }

  void limit(EvaluationRow& row) const {
    if (input_.max_signal_hz > 0.0)
      row.truth_dps = within_band(row.truth_dps, record_.sample_rate_hz, input_.max_signal_hz);
  }

  /// What the sensor measures on an axis that is not judged, deg/s; empty where a file lacks what is needed.
  [[nodiscard]] std::vector<double> beside(const std::string& axis, double scale,
                                           const files::Record* noise) const {
    std::vector<double> rates = gyro_rates(record_, axis);
    if (noise == nullptr) return rates;
    if (!input_.signal_is_truth) rates = truth(axis);
    const std::vector<double> added = gyro_rates(*noise, input_.noise_axes[axis_index(axis)]);
    if (rates.empty() || added.empty()) return {};
    return composite(rates, scaled(without_mean(stretch(added, input_.noise_start, rates.size())), scale));
  }

  /// What is known beforehand of the noise of an axis that is not judged.
  [[nodiscard]] RowNoise told_beside(const std::string& axis, double scale,
                                     const files::Record* noise) const {
    if (noise == nullptr) return told_beforehand(input_.known, axis, {}, 1.0, record_.sample_rate_hz);
    const std::string& added = input_.noise_axes[axis_index(axis)];
    const std::vector<double> all = gyro_rates(*noise, added);
    if (all.empty()) return {};
    return told_beforehand(input_.known, added, spare(all, input_.noise_start, record_.size()), scale,
                           record_.sample_rate_hz);
  }

  /// For rows from `first` on, of one scale, whose noise is not known in full beforehand: what is at rest on all axes that there are, and what the
  /// sensor measures on each.
  void look_beside(std::size_t first, double scale, const files::Record* noise) {
    const std::span<EvaluationRow> rows = std::span(all_.rows).subspan(first);
    if (std::ranges::none_of(rows, asks_other_axes)) return;
    const auto sensor = std::make_shared<SensorAxes>();
    std::array<bool, 3> learns{};
    for (const std::string axis : {"x", "y", "z"}) {
      const std::size_t i = axis_index(axis);
      const auto judged = std::ranges::find(rows, axis, &EvaluationRow::axis);
      const RowNoise told = judged == rows.end() ? told_beside(axis, scale, noise) : judged->noise;
      sensor->noisy_dps[i] = judged == rows.end() ? beside(axis, scale, noise) : judged->noisy_dps;
      sensor->noise[i] = told.course;
      learns[i] = told.learns;
    }
    learn(rows, learns, *sensor);
    all_.judged_alone = noise != nullptr && shares_noise(input_.noise_axes);
    if (all_.judged_alone) return;
    for (EvaluationRow& row : rows) row.sensor = sensor;
  }

  void learn(std::span<EvaluationRow> rows, const std::array<bool, 3>& learns, SensorAxes& sensor) const {
    if (std::ranges::none_of(learns, std::identity{})) return;
    std::array<std::span<const double>, 3> rates;
    std::ranges::copy(sensor.noisy_dps, rates.begin());
    const auto courses = learned_from(rates, record_.sample_rate_hz);
    for (std::size_t i = 0; i < 3; ++i) {
      if (learns[i]) sensor.noise[i] = courses[i];
    }
    for (EvaluationRow& row : rows) {
      if (row.noise.learns) add_learned(courses[axis_index(row.axis)], row.noise);
    }
  }

  void tell_of_calibration(const std::array<std::string, 3>& axes) {
    std::vector<std::string> judged;
    for (const std::string& axis : input_.axes) judged.push_back(axes[axis_index(axis)]);
    for (std::string& caution : calibration_cautions(input_.known, judged, record_.sample_rate_hz))
      all_.cautions.push_back(std::move(caution));
  }

  void tell_of_losses(const files::Record& record, const std::string& what_becomes) {
    const std::string losses = losses_of(record.counts);
    if (!losses.empty()) all_.cautions.push_back(record.name + ": " + losses);
    if (record.counts.gaps == 0) return;
    all_.cautions.push_back(record.name + ": " + std::to_string(record.counts.gaps) + " long gap" +
                            (record.counts.gaps == 1 ? "" : "s") + "; the longest stretch is " +
                            what_becomes + ", " + std::to_string(record.counts.left_out) +
                            " good samples are left out");
  }

  void tell_of_noise(const files::Record& noise) {
    tell_of_losses(noise, "used");
    if (noise.rate_assumed) {
      all_.cautions.push_back(noise.name + ": has no time column; its rate is assumed to be the signal's, " +
                              report::number_text(all_.rate_hz) + " Hz");
    }
    for (const std::string& axis : input_.axes) {
      const std::vector<double> rates = gyro_column(noise, input_.noise_axes[axis_index(axis)]);
      if (report::stillness(rates, noise.sample_rate_hz).still()) continue;
      all_.cautions.push_back(noise.name + ": axis " + input_.noise_axes[axis_index(axis)] +
                              " moves; its motion counts as noise");
    }
    if (input_.noise_start + record_.size() <= noise.size()) return;
    all_.cautions.push_back(noise.name + ": " + std::to_string(noise.size() - input_.noise_start) +
                            " samples from " + std::to_string(input_.noise_start) + " on are too few for " +
                            std::to_string(record_.size()) +
                            " of the signal; they begin again from the first");
  }

  const EvaluationInput& input_;
  files::Record record_;
  std::string prefix_;
  EvaluationRows all_;
};

}  // namespace

EvaluationRows evaluation_rows(const EvaluationInput& input) { return RowMaker(input).make(); }

}  // namespace gyrod::app
