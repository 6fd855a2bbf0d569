/// An evaluation as text, JSON and CSV.
#pragma once

#include <string>
#include <vector>

#include "app/evaluation.hpp"
#include "report/json.hpp"

namespace gyrod::app {

/// All that is told.
struct Evaluation {
  const EvaluationRows& rows;
  const EvaluationOptions& options;
  const std::vector<JudgedRow>& judged;
};

/// Those of the rows, and what the methods did without.
[[nodiscard]] std::vector<std::string> cautions_of(const Evaluation& evaluation);

/// What methods with a model of the noise had of this row: "calibrated by a file of gyrod calibrate", "calibrated from the other samples of the
/// noise file", "learned at rest in the record" or "unknown".
[[nodiscard]] const char* noise_model_words(const JudgedRow& row) noexcept;

/// What the page reads, and evaluation.json holds. Units stand in every key; gains, shares and verdicts have none.
[[nodiscard]] report::Json evaluation_json(const Evaluation& evaluation);

/// Tables for a terminal: RMSE by lag, guards, turns.
[[nodiscard]] std::string evaluation_text(const Evaluation& evaluation);

/// The rows of evaluation.csv, guards.csv and turns.csv, from evaluation_json(): axis and noise scale in front.
[[nodiscard]] report::Json estimator_rows(const report::Json& evaluation);
[[nodiscard]] report::Json guard_rows(const report::Json& evaluation);
[[nodiscard]] report::Json turn_rows(const report::Json& evaluation);

}  // namespace gyrod::app
