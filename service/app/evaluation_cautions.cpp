#include <algorithm>
#include <string>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/evaluated_methods.hpp"
#include "app/evaluation_report.hpp"
#include "core/noise/still_noise.hpp"
#include "settings/unused_keys.hpp"

namespace gyrod::app {
namespace {

using settings::NoiseSource;

/// "axis x, axis z, noise scaled by 3": of the rows that a caution is about; empty where it is about all.
std::string rows_of(const std::vector<const JudgedRow*>& some, std::size_t all) {
  std::string text;
  if (some.size() == all) return text;
  for (const JudgedRow* row : some) {
    text += (text.empty() ? "axis " : ", axis ") + row->axis;
    if (row->noise_scale != 1.0) text += ", noise scaled by " + report::number_text(row->noise_scale);
  }
  return text + ": ";
}

std::string lack_of_spare(const EvaluationRows& rows) {
  return rows.noise_name + ": " + std::to_string(rows.spare_samples) +
         " samples that are not added are too few to tell the noise, or do not vary (expected at least " +
         std::to_string(core::kMinStillSamples) + ")";
}

/// Why nothing is known of the noise, and what that means.
std::string of_guesses(const EvaluationRows& rows) {
  const std::string restless = "the record shows no rest to learn it from";
  const std::string guess =
      "; joint and realtime guess it from each window, as the daemon does without a calibration until the "
      "sensor has been at rest";
  switch (rows.noise_source) {
    case NoiseSource::kImf1:
      return "noise.source is imf1: joint and realtime guess the noise from each window";
    case NoiseSource::kStandstill:
      return "nothing is known of the noise: noise.source is standstill, and " + restless + guess;
    case NoiseSource::kCalibrated:
      return lack_of_spare(rows) + guess;
    case NoiseSource::kAuto:
      break;
  }
  return (rows.noise_name.empty() ? "nothing is known of the noise: " : lack_of_spare(rows) + ", and ") +
         restless + guess;
}

/// The rows that are told nothing, and those that are told only within what is judged.
void tell_of_noise_models(const Evaluation& evaluation, std::vector<std::string>& cautions) {
  const auto& [rows, options, judged] = evaluation;
  std::vector<const JudgedRow*> guessed;
  for (const JudgedRow& row : judged) {
    if (!row.noise_known_from_sample) guessed.push_back(&row);
    const std::size_t from = row.noise_known_from_sample.value_or(0);
    if (from <= options.range.begin) continue;
    cautions.push_back(rows_of({&row}, judged.size()) + "the noise is known from sample " +
                       std::to_string(from) +
                       " on, after the record's first rest; before, joint and realtime guess it");
  }
  if (!guessed.empty()) cautions.push_back(rows_of(guessed, judged.size()) + of_guesses(rows));
  if (rows.judged_alone) {
    cautions.emplace_back(
        "axes are given the same noise: each is judged by itself, while the daemon also looks at what a "
        "sensor's axes share");
  }
}

/// Shorter spells are knocks, and rough road.
constexpr double kMuchMisfit = 0.2;

/// What to look at where noise is not as it is believed to be.
const char* suspicion(const EvaluationRows& rows, NoiseKnownBy by) noexcept {
  switch (by) {
    case NoiseKnownBy::kCalibration:
      return "is the calibration of this sensor, at this rate?";
    case NoiseKnownBy::kSpareSamples:
      return rows.signal_is_truth ? "the rates that are taken for the truth have noise of their own"
                                  : "is the sensor at rest in all of the noise file?";
    case NoiseKnownBy::kRest:
      return "was the sensor at rest where it was learned?";
    case NoiseKnownBy::kMotion:
      return "does it shake as noise would?";
    case NoiseKnownBy::kLines:
    case NoiseKnownBy::kNothing:
      break;
  }
  return "it changes";
}

/// Of the methods that take a noise model, which are those that take a signal band.
void tell_of_models(const Evaluation& evaluation, std::vector<std::string>& cautions) {
  tell_of_noise_models(evaluation, cautions);
  const std::string band =
      settings::unused_band(evaluation.options.settings.denoise.max_signal_hz, evaluation.rows.rate_hz);
  if (!band.empty()) cautions.push_back(band);
}

/// Why the model does not fit.
std::string why_not(const EvaluationRows& rows, const JudgedRow& row) {
  if (row.hidden_noise_share > kMuchMisfit) {
    return "a low-pass of the sensor's own hides the noise, and next to nothing is denoised until it is "
           "known; "
           "calibrate the sensor (--calibration)";
  }
  if (row.noise_ratio == 1.0) return "the deviations that they claim are not to be trusted";
  return fmt::format("the noise has {:.2g} times the deviation that is believed; {}", row.noise_ratio,
                     suspicion(rows, row.noise_known_by));
}

/// The daemon would flag these samples.
void tell_of_misfits(const Evaluation& evaluation, std::vector<std::string>& cautions) {
  const auto& [rows, options, judged] = evaluation;
  for (const JudgedRow& row : judged) {
    if (!(row.misfit_share.value_or(0.0) > kMuchMisfit)) continue;
    cautions.push_back(
        rows_of({&row}, judged.size()) +
        fmt::format("the model of joint and realtime does not fit {:.0f} % of the judged samples "
                    "(FLAG_MODEL_MISFIT): {}",
                    100.0 * *row.misfit_share, why_not(rows, row)));
  }
}

/// Raw in parts of the truth: beyond these no two sensors differ that measure the same.
constexpr double kLeastScale = 0.7;
constexpr double kMostScale = 1.4;

/// Columns in another unit than their names say, or of another axis, make every method look alike.
void tell_of_other_units(const Evaluation& evaluation, std::vector<std::string>& cautions) {
  const auto& [rows, options, judged] = evaluation;
  for (const JudgedRow& row : judged) {
    const auto raw = std::ranges::find(row.estimators, std::string("raw"), &JudgedEstimator::name);
    if (raw == row.estimators.end() || raw->lags.empty() || !raw->lags.front().figures.scale_factor) continue;
    const double scale = raw->lags.front().figures.scale_factor->value;
    if (scale >= kLeastScale && scale <= kMostScale) continue;
    cautions.push_back(
        rows_of({&row}, judged.size()) +
        fmt::format("raw is {:.3g} times the truth: are the columns in the units of their names, and "
                    "do the axes belong together (--truth-axes)?",
                    scale));
  }
}

}  // namespace

std::vector<std::string> cautions_of(const Evaluation& evaluation) {
  std::vector<std::string> all = evaluation.rows.cautions;
  if (std::ranges::any_of(evaluation.options.methods, takes_noise_model)) tell_of_models(evaluation, all);
  tell_of_misfits(evaluation, all);
  if (evaluation.rows.noise_name.empty()) tell_of_other_units(evaluation, all);
  return all;
}

const char* noise_model_words(const JudgedRow& row) noexcept {
  switch (row.noise_known_by) {
    case NoiseKnownBy::kCalibration:
      return "calibrated by a file of gyrod calibrate";
    case NoiseKnownBy::kSpareSamples:
      return "calibrated from the other samples of the noise file";
    case NoiseKnownBy::kRest:
      return "learned at rest in the record";
    case NoiseKnownBy::kMotion:
      return "learned in motion, behind the sensor's low-pass";
    case NoiseKnownBy::kLines:
      return "unknown but for lines, learned in motion";
    case NoiseKnownBy::kNothing:
      break;
  }
  return "unknown";
}

}  // namespace gyrod::app
