#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/evaluation_report.hpp"
#include "stream/hop_schedule.hpp"

namespace gyrod::app {
namespace {

constexpr int kNameWidth = 26;
constexpr int kNumberWidth = 9;
constexpr int kAngleWidth = 12;
constexpr int kNormalisedWidth = 14;

std::string padded(const std::string& text, int width) {
  const std::size_t wanted =
      static_cast<std::size_t>(width) - std::min(text.size(), static_cast<std::size_t>(width));
  std::string padding(wanted, ' ');
  return padding;
}
std::string left(const std::string& text, int width) { return text + padded(text, width); }
/// Never runs into its neighbour.
std::string right(const std::string& text, int width = kNumberWidth) {
  const std::string padding = padded(text, width);
  return (padding.empty() ? " " : padding) + text;
}

/// What rounds to nothing has no sign.
std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  const std::string_view shown = text.data();
  const bool nothing = shown.find_first_of("123456789") == std::string_view::npos;
  return std::string(nothing && shown.starts_with('-') ? shown.substr(1) : shown);
}
/// 0.01, 3, 0.0936
std::string short_number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}
std::string fixed(const std::optional<double>& value, int decimals, double factor = 1.0) {
  return value ? fixed(factor * *value, decimals) : "-";
}

/// "x from -y, z from z": of the judged axes.
std::string mapped(const EvaluationRows& rows, const std::array<std::string, 3>& axes) {
  std::string text;
  for (const std::string& axis : rows.axes)
    text += (text.empty() ? "" : ", ") + axis + " from " + axes[static_cast<std::size_t>(axis[0] - 'x')];
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// Where joint's windows are longer than configured.
std::string longer_windows(const stream::EngineOptions& engine, double rate_hz) {
  const unsigned doublings = stream::doublings_at(engine, rate_hz);
  if (doublings == 0) return "";
  return " (joint and realtime at this rate: up to " + std::to_string(engine.window_samples << doublings) +
         ", " + std::to_string(engine.hop_samples << stream::hop_doublings(doublings)) + ")";
}

/// What was run on what, so that it can be run again.
std::string head(const Evaluation& evaluation) {
  const auto& [rows, options, judged] = evaluation;
  const stream::EngineOptions& engine = options.settings.engine;
  const double max_signal_hz = options.settings.denoise.max_signal_hz;
  std::string text = rows.name + ": " + std::to_string(rows.samples) + " samples at " +
                     report::number_text(rows.rate_hz) + " Hz, truth " +
                     (rows.signal_is_truth ? "the rates themselves"
                                           : rows.truth_columns + ": " + mapped(rows, rows.truth_axes)) +
                     "\n";
  if (!rows.noise_name.empty()) {
    text += "noise of " + rows.noise_name + ": " + mapped(rows, rows.noise_axes) + ", from sample " +
            std::to_string(rows.noise_start) + " on, added sample by sample\n";
  }
  if (!rows.calibration_file.empty()) text += "calibration of the noise: " + rows.calibration_file + "\n";
  return text + "judged: " + joined(options.methods) + " on samples " + std::to_string(options.range.begin) +
         " to " + std::to_string(options.range.end) + "; window " + std::to_string(engine.window_samples) +
         ", hop " + std::to_string(engine.hop_samples) + longer_windows(engine, rows.rate_hz) + ", lag " +
         std::to_string(engine.lag_samples) + " samples, " +
         (max_signal_hz > 0.0 ? "signal and truth up to " + short_number(max_signal_hz) + " Hz"
                              : "signal of any frequency") +
         "\n";
}

std::string row_name(const JudgedRow& row) {
  return "axis " + row.axis + ", noise " + fixed(row.noise_std_dps, 3) + " deg/s" +
         (row.noise_scale == 1.0 ? std::string() : " (scaled by " + short_number(row.noise_scale) + ")") +
         ", motion " + fixed(row.truth_std_dps, 3) + " deg/s; noise model " + noise_model_words(row) +
         (row.noise_known_from_sample.value_or(0) > 0
              ? ", from sample " + std::to_string(*row.noise_known_from_sample) + " on"
              : "");
}

std::string line_of(const JudgedEstimator& estimator) {
  const bool tuned = estimator.kind == EstimatorKind::kFilter || estimator.kind == EstimatorKind::kBound;
  std::string text = "  " + left(estimator.name + (tuned ? " *" : ""), kNameWidth);
  for (const JudgedLag& lag : estimator.lags) text += right(fixed(lag.figures.rmse, 4));
  const JudgedLag& last = estimator.lags.back();
  const auto& angle = last.figures.angle_60s ? last.figures.angle_60s : last.figures.angle_10s;
  text += right(fixed(last.figures.rmse_without_bias, 4), kAngleWidth) +
          right(angle ? fixed(angle->rms, 3) : "-", kAngleWidth);
  text += right(last.figures.normalised_error ? fixed(last.figures.normalised_error, 2) + " / " +
                                                    fixed(last.figures.normalised_error_without_bias, 2)
                                              : "-",
                kNormalisedWidth);
  if (!last.tuning.empty()) text += "   " + last.tuning;
  if (estimator.kind == EstimatorKind::kFilter) text += ", lag " + std::to_string(last.lag_samples);
  return text + "\n";
}

std::string errors_table(const JudgedRow& row, const EvaluationOptions& options) {
  const JudgedLag& first = row.estimators.front().lags.back();
  std::string text = "\n" + row_name(row) + "\n  " + left("RMSE, deg/s, by lag", kNameWidth);
  for (const std::size_t lag : options.lag_samples) text += right(std::to_string(lag));
  text += right("less bias", kAngleWidth) +
          right(first.figures.angle_60s ? "60 s, deg" : "10 s, deg", kAngleWidth) +
          right("normalised", kNormalisedWidth) + "\n";
  for (const JudgedEstimator& estimator : row.estimators) text += line_of(estimator);
  if (first.figures.lost_truth > 0) {
    text += "  " + std::to_string(first.figures.lost_truth) + " samples have no truth and are not judged\n";
  }
  return text;
}

std::string guard_cell(const core::Guard& guard) {
  if (guard.verdict == core::Verdict::kNotApplicable)
    return guard.value ? "(" + fixed(guard.value, 3) + ")" : "-";
  return fixed(guard.value, 3) + (guard.verdict == core::Verdict::kPass ? " ok" : " FAIL");
}

/// With the mark of what is tuned on the truth.
std::string starred(const std::string& name) { return name + (name.starts_with("Butterworth") ? " *" : ""); }

/// Columns of a table of guards are as wide as their heads, and at least so wide.
constexpr int kGuardWidth = 16;

int guard_width(const JudgedGuards& judged) {
  return std::max(kGuardWidth, static_cast<int>(starred(judged.name).size()) + 2);
}

/// Of those who have a value: one, or, where it depends on what they made of the record, of each in the order of the columns.
std::string limits_of(const JudgedRow& row, std::size_t guard) {
  std::vector<std::string> limits;
  for (const JudgedGuards& judged : row.guards) {
    if (judged.guards[guard].value) limits.push_back(short_number(judged.guards[guard].limit));
  }
  if (limits.empty()) return short_number(row.guards.front().guards[guard].limit);
  std::string text = limits.front();
  if (std::ranges::count(limits, text) == std::ssize(limits)) return text;
  for (const std::string& other : std::span(limits).subspan(1)) text += "; " + other;
  return text;
}

std::string guards_table(const JudgedRow& row) {
  std::string text = "\n  " + left("guards", kNameWidth);
  for (const JudgedGuards& judged : row.guards) text += right(starred(judged.name), guard_width(judged));
  text += right("limit", kGuardWidth) + "\n";
  for (std::size_t i = 0; i < row.guards.front().guards.size(); ++i) {
    const core::Guard& first = row.guards.front().guards[i];
    text += "  " + left(std::string(core::name_of(first.kind)), kNameWidth);
    for (const JudgedGuards& judged : row.guards)
      text += right(guard_cell(judged.guards[i]), guard_width(judged));
    const bool gain =
        first.kind == core::GuardKind::kSlowTurnGain || first.kind == core::GuardKind::kSwingGain ||
        first.kind == core::GuardKind::kScaleFactor || first.kind == core::GuardKind::kVibrationGain;
    text += "  " + right((gain ? "1 +- " : "") + limits_of(row, i), kGuardWidth - 2) + "\n";
  }
  return text;
}

std::string turns_table(const JudgedRow& row) {
  if (row.turns.empty()) return "";
  std::string text = "\n  " + left("turn after 60 s straight", kNameWidth) + left("", 22) +
                     right("50 %, ms") + right("95 %, ms") + right("over, %") +
                     right("peak error, deg/s", 20) + "\n";
  for (const JudgedTurn& turn : row.turns) {
    text += "  " + left(turn.profile, kNameWidth) + left(starred(turn.name), 22) +
            right(fixed(turn.response.half_delay_s, 0, 1e3)) + right(fixed(turn.response.time_95_s, 0, 1e3)) +
            right(fixed(100.0 * turn.response.overshoot, 1)) +
            right(fixed(turn.response.peak_error_dps, 2), 20) + "\n";
  }
  return text;
}

}  // namespace

std::string evaluation_text(const Evaluation& evaluation) {
  std::string text = head(evaluation);
  for (const std::string& caution : cautions_of(evaluation)) text += "caution: " + caution + "\n";
  for (const JudgedRow& row : evaluation.judged) {
    text += errors_table(row, evaluation.options) + guards_table(row) + turns_table(row);
  }
  text +=
      "\n* tuned on the truth, which no user can do: the order and cut-off (or length, ...) and the delay up "
      "to the lag that\n"
      "  make the RMSE least; zero-phase looks at the whole record. Tuning, and what follows the RMSE, for "
      "the largest lag:\n"
      "  RMSE of the error less its mean; angle error, rms over windows; error in parts of the claimed "
      "deviation, with and\n"
      "  without the mean (1 is right, more is too bold). Guards and turns: methods at the lag of the "
      "configuration,\n  " +
      std::to_string(evaluation.options.settings.engine.lag_samples) +
      " samples, realtime at 0, beside a Butterworth for each; in brackets: not judged, for a reason that "
      "guards.csv has.\n";
  return text;
}

}  // namespace gyrod::app
