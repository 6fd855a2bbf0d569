/// The command line of `gyrod evaluate`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/evaluation.hpp"

namespace gyrod::app {

/// What is given, or what holds where nothing is.
struct EvaluateFlags {
  EvaluationInput input;
  std::string config;
  std::string folder;
  std::string truth_prefix;
  std::vector<std::string> truth_axes;
  std::vector<std::string> noise_axes;
  std::string calibration;
  std::string sensor;  ///< whose calibration
  std::string from;
  std::string to;
  std::vector<std::string> methods = {"joint", "realtime", "improved"};
  std::vector<std::size_t> lags = {0, 4, 8, 12, 16, 32};
  bool no_turns = false;
  std::size_t turn_repeats = 3;
};

/// Adds the input and all options.
/// @param flags has to outlive the command
void add_evaluate_options(CLI::App& command, EvaluateFlags& flags);

/// What is judged, at which lags: those of the flags, the configuration's, and 0 where a method answers at once, so that each method has a row of
/// filters beside it that may be as late as it is. The range is left open.
/// @throws CLI::ValidationError for a lag that a method does not take  @throws settings::SettingsError
[[nodiscard]] EvaluationOptions options_of(const EvaluateFlags& flags);

/// Where truth and noise come from, what of them is good, and, for methods that take a model of it, what is known of the noise.
/// @param options of the same flags
/// @throws CLI::ValidationError for flags that do not go together, and a calibration of another sensor
/// @throws settings::NoiseFileError for a calibration that cannot be used
[[nodiscard]] EvaluationInput input_of(const EvaluateFlags& flags, const EvaluationOptions& options);

}  // namespace gyrod::app
