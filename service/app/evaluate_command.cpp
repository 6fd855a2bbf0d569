#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/evaluated_methods.hpp"
#include "app/evaluation.hpp"
#include "app/evaluation_folder.hpp"
#include "app/evaluation_report.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

struct EvaluateFlags {
  EvaluationInput input;
  std::string config;
  std::string folder;
  std::string truth_prefix;
  std::vector<std::string> truth_axes;
  std::vector<std::string> noise_axes;
  std::string from;
  std::string to;
  std::vector<std::string> methods = {"improved"};
  std::vector<std::size_t> lags = {0, 4, 8, 12, 16, 32};
  bool no_turns = false;
  std::size_t turn_repeats = 3;
};

/// "2400" or "20s" in samples. @pre checked by sample_or_seconds()
std::size_t sample_of(const std::string& text, double rate_hz) {
  const bool seconds = text.back() == 's';
  const double value = std::stod(text);
  return static_cast<std::size_t>(std::llround(seconds ? value * rate_hz : value));
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

EvaluationInput input_of(const EvaluateFlags& flags) {
  EvaluationInput input = flags.input;
  if (!flags.truth_prefix.empty()) input.truth_prefix = flags.truth_prefix;
  input.truth_axes = axes_of(flags.truth_axes, "--truth-axes");
  input.noise_axes = axes_of(flags.noise_axes, "--noise-axes");
  const bool about_noise =
      input.noise_start > 0 || !flags.noise_axes.empty() || input.noise_scales != std::vector<double>{1.0};
  if (about_noise && input.noise.empty())
    throw CLI::ValidationError("--noise-scale, --noise-axes, --noise-start",
                               "need --noise, the recording at rest");
  if (input.signal_is_truth && input.noise.empty())
    throw CLI::ValidationError("--signal-is-truth", "needs --noise: without it there would be no error");
  return input;
}

/// From 20 s on, when estimators have settled, or from the start where that would leave less than half.
core::SampleRange range_of(const EvaluateFlags& flags, const EvaluationRows& rows) {
  constexpr double kSettled_s = 20.0;
  const auto settled = static_cast<std::size_t>(kSettled_s * rows.rate_hz);
  core::SampleRange range{2 * settled <= rows.samples ? settled : 0, rows.samples};
  if (!flags.from.empty()) range.begin = sample_of(flags.from, rows.rate_hz);
  if (!flags.to.empty()) range.end = std::min(sample_of(flags.to, rows.rate_hz), rows.samples);
  constexpr std::size_t kFewest = 100;
  if (range.begin + kFewest > range.end) {
    throw CLI::ValidationError("--from", "and --to leave the samples " + std::to_string(range.begin) +
                                             " to " + std::to_string(range.end) + " of " +
                                             std::to_string(rows.samples) + "; expected at least 100");
  }
  return range;
}

void check_truth_in(const EvaluationRows& rows, core::SampleRange range) {
  for (const EvaluationRow& row : rows.rows) {
    const auto begin = row.truth_dps.begin();
    const auto known = std::count_if(begin + static_cast<std::ptrdiff_t>(range.begin),
                                     begin + static_cast<std::ptrdiff_t>(range.end),
                                     [](double value) { return std::isfinite(value); });
    if (known > 1) continue;
    throw files::FileError(rows.name + ": the truth of axis " + row.axis + " is not known between samples " +
                           std::to_string(range.begin) + " and " + std::to_string(range.end));
  }
}

void check_lags(const EvaluationOptions& options) {
  for (const std::string& name : options.methods) {
    const std::size_t most = largest_lag(name, options.settings);
    const std::size_t given = std::max(options.lag_samples.back(), options.settings.engine.lag_samples);
    if (given <= most) continue;
    throw CLI::ValidationError("--lag", "or denoise.lag_samples is " + std::to_string(given) + "; " + name +
                                            " takes at most " + std::to_string(most));
  }
}

EvaluationRows load(const EvaluateFlags& flags, Interrupt& interrupt) {
  if (flags.input.recording == "-") interrupt.let_through();
  ProgressBar bar("reading");
  EvaluationInput input = input_of(flags);
  input.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    bar.show(fraction, rows);
    return !interrupt.requested();
  };
  return evaluation_rows(input);
}

int evaluate_or_stop(const EvaluateFlags& flags, Interrupt& interrupt) {
  EvaluationOptions options;
  options.settings = load_or_default(flags.config);
  options.methods = flags.methods;
  options.lag_samples = flags.lags;
  std::ranges::sort(options.lag_samples);
  auto& lags = options.lag_samples;
  lags.erase(std::unique(lags.begin(), lags.end()), lags.end());
  options.turns = !flags.no_turns;
  options.turn_repeats = flags.turn_repeats;
  check_lags(options);
  std::optional<EvaluationFolder> folder;
  if (!flags.folder.empty()) folder.emplace(flags.folder);

  const EvaluationRows rows = load(flags, interrupt);
  options.range = range_of(flags, rows);
  check_truth_in(rows, options.range);
  std::vector<JudgedRow> judged;
  {
    ProgressBar bar("evaluating");
    const auto samples = static_cast<double>(rows.samples * rows.rows.size());
    options.look = [&](double fraction) {
      bar.show(fraction, static_cast<std::uint64_t>(fraction * samples));
      return !interrupt.requested();
    };
    judged = evaluate(rows, options);
  }
  if (judged.empty()) throw files::Stopped{};
  const Evaluation evaluation{rows, options, judged};
  std::fputs(evaluation_text(evaluation).c_str(), stdout);
  std::fflush(stdout);
  if (folder) {
    folder->write(evaluation_json(evaluation));
    std::fprintf(stderr, "%s/evaluation.html\n", flags.folder.c_str());
  }
  return kDone;
}

int evaluate_recording(const EvaluateFlags& flags, Interrupt& interrupt) {
  try {
    return evaluate_or_stop(flags, interrupt);
  } catch (const files::Stopped&) {
    std::fprintf(stderr, "gyrod: interrupted\n");
    return kInterrupted;
  }
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
      .add_option("--noise", flags.input.noise,
                  "A recording at rest: its deviation from its mean is added to the truth, sample by sample")
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
      ->check(in_range(0, 1e12));
}

void add_methods(CLI::App& command, EvaluateFlags& flags) {
  command
      .add_option("--methods", flags.methods,
                  "direct, emd, acf-emd, improved, joint, realtime, separated by commas [improved]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(evaluated_method_names()));
  command.add_option("--lag", flags.lags, "Lags in samples, separated by commas [0,4,8,12,16,32]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(in_range(0, 1e6));
  command.add_option("--config", flags.config, "Configuration file: its groups denoise and limits")
      ->type_name("FILE");
  command.add_flag("--no-turns", flags.no_turns, "Leave out the turns after 60 s straight, half of the work");
  command
      .add_option("--turn-repeats", flags.turn_repeats,
                  "Runs of each turn, with other stretches of the noise [3]")
      ->type_name("N")
      ->check(in_range(1, 1000));
}

}  // namespace

void add_evaluate(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand(
      "evaluate", "How good the estimate is where the truth is known, beside filters tuned on that truth");
  const auto flags = std::make_shared<EvaluateFlags>();
  add_input(*command, *flags);
  add_truth(*command, *flags);
  add_noise(*command, *flags);
  add_methods(*command, *flags);
  command
      ->add_option("-o,--output", flags->folder,
                   "Folder for evaluation.html, evaluation.json, evaluation.csv, guards.csv, turns.csv")
      ->type_name("DIR");
  command->footer(
      "The truth is either a better gyro in the same recording (columns ref_gyro_{x,y,z}_UNIT, or others), "
      "or made: a\n"
      "quiet signal with the noise of your sensor at rest on top. Raw rates, low-passes and averages stand "
      "beside gyrod,\n"
      "each tuned on the truth at the same lag: a bar that no user can reach. Guards say whether an estimate "
      "shrinks,\n"
      "delays or steps; turns, how quickly it follows (docs/evaluate.md).\n\n"
      "Examples:\n"
      "  gyrod evaluate drive_with_reference.csv.gz -o evaluation\n"
      "  gyrod evaluate drive_with_reference.csv --noise still.csv --noise-scale 0.3,1,3 --rate 100 -o "
      "evaluation\n"
      "  gyrod evaluate good_gyro.csv --signal-is-truth --noise cheap_gyro_still.csv --axis z --lag 0,16,32");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return evaluate_recording(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
