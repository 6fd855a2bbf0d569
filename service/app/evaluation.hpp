/// Judges estimators on the rows of an evaluation, beside filters that are tuned on the truth.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation_rows.hpp"
#include "core/evaluation/error_figures.hpp"
#include "core/evaluation/guards.hpp"
#include "core/evaluation/tuning.hpp"
#include "core/evaluation/turns.hpp"
#include "settings/settings.hpp"

namespace gyrod::app {

struct EvaluationOptions {
  settings::Settings settings;
  std::vector<std::string> methods = {"joint", "realtime", "improved"};
  std::vector<std::size_t> lag_samples = {0, 8, 16};  ///< rising
  core::SampleRange range;
  bool turns = true;
  std::size_t turn_repeats = 3;
  std::size_t threads = 1;  ///< that judge rows; the result does not depend on it
  /// Called before each step with the part that is done, by one thread at a time. @return false to stop
  std::function<bool(double fraction)> look;
};

/// What a row of the table is.
enum class EstimatorKind : std::uint8_t {
  kMethod,     ///< gyrod's, not tuned
  kUntouched,  ///< raw, and raw less its bias
  kFilter,     ///< causal, tuned on the truth
  kBound,      ///< zero-phase, tuned on the truth, offline
};

/// One estimator with at most so much lag.
struct JudgedLag {
  std::size_t lag_bound = 0;
  std::size_t lag_samples = 0;  ///< that it has
  std::string tuning;           ///< "cut-off 2.13 Hz"; empty where there is nothing to tune
  core::ErrorFigures figures;
};

struct JudgedEstimator {
  std::string name;
  EstimatorKind kind = EstimatorKind::kMethod;
  std::vector<JudgedLag> lags;  ///< one for each lag that was asked for
};

struct JudgedGuards {
  std::string name;
  std::vector<core::Guard> guards;
};

struct JudgedTurn {
  std::string name;
  std::string profile;
  core::TurnResponse response;
};

/// Share of the errors in bins of equal width; what lies outside counts in the first and last.
struct ErrorHistogram {
  std::string name;
  std::vector<double> shares;
};

struct JudgedRow {
  std::string axis;
  double noise_scale = 1.0;
  double noise_std_dps = 0.0;
  double truth_std_dps = 0.0;
  // To methods that take a model of it.
  NoiseKnownBy noise_known_by = NoiseKnownBy::kNothing;
  std::optional<std::size_t> noise_known_from_sample;
  std::optional<double>
      misfit_share;  ///< of the judged samples at which their model says that it does not fit; nothing: none has one
  double hidden_noise_share = 0.0;  ///< of them at which it says that a low-pass hides the noise
  double noise_ratio = 1.0;         ///< Contender::noise_ratio
  std::vector<JudgedEstimator> estimators;
  // All methods with the lag of the configuration, and for each lag that they answer with the best causal Butterworth: "Butterworth" for
  // the configuration's, "Butterworth, lag 0".
  std::vector<JudgedGuards> guards;
  std::vector<JudgedTurn> turns;
  std::vector<double> bin_centres_dps;
  std::vector<ErrorHistogram> histograms;
};

/// @return a row for each of rows.rows; nothing where `look` stopped it
[[nodiscard]] std::vector<JudgedRow> evaluate(const EvaluationRows& rows, const EvaluationOptions& options);

}  // namespace gyrod::app
