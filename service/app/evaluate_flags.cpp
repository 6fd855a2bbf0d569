#include "app/evaluate_flags.hpp"

#include <algorithm>
#include <array>

#include "app/evaluated_methods.hpp"
#include "app/flags.hpp"
#include "app/options.hpp"

namespace gyrod::app {
namespace {

/// Each the first time that it is given.
template <class T>
void keep_each_once(std::vector<T>& given) {
  std::vector<T> once;
  for (const T& one : given) {
    if (std::ranges::find(once, one) == once.end()) once.push_back(one);
  }
  given = std::move(once);
}

std::string check_sample_or_seconds(const std::string& text) {
  const bool seconds = !text.empty() && text.back() == 's';
  double value = -1.0;
  const bool good = CLI::detail::lexical_cast(seconds ? text.substr(0, text.size() - 1) : text, value);
  if (good && value >= 0.0 && value <= 1e9) return {};
  return "'" + text + "' given; expected samples, as 2400, or seconds, as 20s";
}

/// Three axes for x, y, z; one stands for all.
std::array<std::string, 3> axes_of(const std::vector<std::string>& given, const char* flag) {
  if (given.empty()) return {"x", "y", "z"};
  if (given.size() == 1) return {given[0], given[0], given[0]};
  if (given.size() == 3) return {given[0], given[1], given[2]};
  throw CLI::ValidationError(
      flag, std::to_string(given.size()) + " axes given; expected one, or three for x, y, z");
}

/// Rising, each once.
std::vector<std::size_t> lags_of(const EvaluateFlags& flags, const EvaluationOptions& options) {
  std::vector<std::size_t> lags = flags.lags;
  lags.push_back(options.settings.engine.lag_samples);
  if (std::ranges::any_of(options.methods, answers_at_once)) lags.push_back(0);
  std::ranges::sort(lags);
  lags.erase(std::unique(lags.begin(), lags.end()), lags.end());
  return lags;
}

void check_lags(const EvaluationOptions& options) {
  for (const std::string& name : options.methods) {
    const std::size_t most = largest_lag(name, options.settings);
    const std::size_t given = options.lag_samples.back();
    if (given <= most) continue;
    throw CLI::ValidationError("--lag", "the largest, of its own and denoise.lag_samples, is " +
                                            std::to_string(given) + "; expected at most " +
                                            std::to_string(most) + " for " + name);
  }
}

/// Nothing where no method asks for it.
NoiseKnowledge knowledge_of(const EvaluateFlags& flags, const EvaluationOptions& options) {
  const bool asked = std::ranges::any_of(options.methods, takes_noise_model);
  if (!asked && !flags.calibration.empty())
    throw CLI::ValidationError("--calibration", "is for joint and realtime; --methods has neither");
  if (!flags.sensor.empty() && flags.calibration.empty() && flags.config.empty())
    throw CLI::ValidationError("--sensor", "finds its calibration in --calibration or --config; give one");
  if (!asked) return {options.settings.noise.source, "", std::nullopt};
  return noise_knowledge(flags.calibration, flags.sensor, options.settings.noise);
}

void add_input(CLI::App& command, EvaluateFlags& flags) {
  command.add_option("input", flags.input.recording, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command
      .add_option("--rate", flags.input.rate_hz,
                  "Sample rate of recording and noise in Hz; it holds, whatever the stamps say [from the "
                  "time column]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command.add_option("--axis", flags.input.axes, "Axes to judge, separated by commas [x,y,z]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"x", "y", "z"}));
  command
      .add_option("--from", flags.from,
                  "First sample to judge, or seconds: 2400, 20s [20s where that leaves half]")
      ->type_name("N|Ss")
      ->check(CLI::Validator(check_sample_or_seconds, ""));
  command.add_option("--to", flags.to, "End of what is judged, not included [the end]")
      ->type_name("N|Ss")
      ->check(CLI::Validator(check_sample_or_seconds, ""));
  command.add_flag("--skip-broken-rows", flags.input.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
}

void add_truth(CLI::App& command, EvaluateFlags& flags) {
  command
      .add_option("--truth-columns", flags.truth_prefix,
                  "Beginning of the truth's column names: PREFIXx_UNIT, ... [truth_ or ref_gyro_]")
      ->type_name("PREFIX");
  command
      .add_option("--truth-axes", flags.truth_axes,
                  "The truth of the sensor's x, y, z, where frames differ: --truth-axes=-y,x,z [x,y,z]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  command.add_flag("--signal-is-truth", flags.input.signal_is_truth,
                   "With --noise: the recorded rates themselves are the truth");
}

void add_noise(CLI::App& command, EvaluateFlags& flags) {
  command
      .add_option(
          "--noise", flags.input.noise,
          "A recording at rest: its deviation from its mean is added to the truth, sample by sample;\n"
          "- for standard input")
      ->type_name("STILL.csv[.gz]");
  command
      .add_option("--noise-scale", flags.input.noise_scales,
                  "What the noise is multiplied by, separated by commas [1]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(in_range(1e-6, 1e6));
  command
      .add_option("--noise-axes", flags.noise_axes,
                  "The noise of the axes x, y, z; one for all: --noise-axes x [x,y,z]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  command.add_option("--noise-start", flags.input.noise_start, "First sample of the noise [0]")
      ->type_name("N")
      ->check(whole_in_range(0, 1000000000000));
  command
      .add_option(
          "--calibration", flags.calibration,
          "Calibration of the noise that is added, or of the recording's sensor, by gyrod calibrate, for\n"
          "joint and realtime [by noise.source: as configured, else the samples of --noise that are not\n"
          "added, else learned in the record]")
      ->type_name("FILE.json");
  command.add_option("--sensor", flags.sensor, "Whose noise it is: finds its calibration")
      ->type_name("ID")
      ->check(sensor_id());
}

void add_methods(CLI::App& command, EvaluateFlags& flags) {
  command
      .add_option(
          "--methods", flags.methods,
          "direct, emd, acf-emd, improved, joint, realtime, separated by commas [joint,realtime,improved]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(evaluated_method_names()));
  command
      .add_option(
          "--lag", flags.lags,
          "Lags in samples, separated by commas; the configuration's and, with realtime, 0 are always\n"
          "among them [0,4,8,12,16,32]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(whole_in_range(0, 1000000));
  command.add_option("--config", flags.config, "Configuration file: its groups denoise, limits and noise")
      ->type_name("FILE");
  command.add_flag("--no-turns", flags.no_turns, "Leave out the turns after 60 s straight, half of the work");
  command
      .add_option("--turn-repeats", flags.turn_repeats,
                  "Runs of each turn, with other stretches of the noise [3]")
      ->type_name("N")
      ->check(whole_in_range(1, 1000));
}

}  // namespace

void add_evaluate_options(CLI::App& command, EvaluateFlags& flags) {
  add_input(command, flags);
  add_truth(command, flags);
  add_noise(command, flags);
  add_methods(command, flags);
  command
      .add_option("-o,--output", flags.folder,
                  "Folder for evaluation.html, evaluation.json, evaluation.csv, guards.csv, turns.csv")
      ->type_name("DIR");
}

EvaluationOptions options_of(const EvaluateFlags& flags) {
  EvaluationOptions options;
  options.settings = load_or_default(flags.config);
  options.methods = flags.methods;
  keep_each_once(options.methods);
  options.lag_samples = lags_of(flags, options);
  options.turns = !flags.no_turns;
  options.turn_repeats = flags.turn_repeats;
  options.threads = worker_threads(options.settings);
  check_lags(options);
  return options;
}

EvaluationInput input_of(const EvaluateFlags& flags, const EvaluationOptions& options) {
  EvaluationInput input = flags.input;
  input.max_rate_radps = options.settings.engine.max_rate_radps;
  input.max_bridged_samples = options.settings.engine.max_bridged_samples;
  input.max_signal_hz = options.settings.denoise.max_signal_hz;
  keep_each_once(input.axes);
  keep_each_once(input.noise_scales);
  if (!flags.truth_prefix.empty()) input.truth_prefix = flags.truth_prefix;
  input.truth_axes = axes_of(flags.truth_axes, "--truth-axes");
  input.noise_axes = axes_of(flags.noise_axes, "--noise-axes");
  const bool about_noise =
      input.noise_start > 0 || !flags.noise_axes.empty() || input.noise_scales != std::vector<double>{1.0};
  if (about_noise && input.noise.empty())
    throw CLI::ValidationError("--noise-scale, --noise-axes, --noise-start",
                               "need --noise, the recording at rest");
  if (input.recording == "-" && input.noise == "-")
    throw CLI::ValidationError("--noise", "and the recording cannot both be standard input");
  if (input.signal_is_truth && input.noise.empty())
    throw CLI::ValidationError("--signal-is-truth", "needs --noise: without it there would be no error");
  const bool about_truth = !flags.truth_prefix.empty() || !flags.truth_axes.empty();
  if (input.signal_is_truth && about_truth)
    throw CLI::ValidationError("--signal-is-truth",
                               "excludes --truth-columns and --truth-axes: no other column is read");
  input.known = knowledge_of(flags, options);
  return input;
}

}  // namespace gyrod::app
