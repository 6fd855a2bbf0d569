#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/command.hpp"
#include "app/evaluate_flags.hpp"
#include "app/evaluated_methods.hpp"
#include "app/evaluation.hpp"
#include "app/evaluation_folder.hpp"
#include "app/evaluation_report.hpp"
#include "app/exit_code.hpp"
#include "app/progress_bar.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

/// "2400" or "20s" in samples. @pre checked by sample_or_seconds()
std::size_t sample_of(const std::string& text, double rate_hz) {
  const bool seconds = text.back() == 's';
  const double value = std::stod(text);
  return static_cast<std::size_t>(std::llround(seconds ? value * rate_hz : value));
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
    throw CLI::ValidationError("--from", "with --to it leaves the samples " + std::to_string(range.begin) +
                                             " to " + std::to_string(range.end) + " of " +
                                             std::to_string(rows.samples) + "; expected at least 100");
  }
  return range;
}

void check_truth_in(const EvaluationRows& rows, core::SampleRange range, double max_signal_hz) {
  for (const EvaluationRow& row : rows.rows) {
    const auto begin = row.truth_dps.begin();
    const auto known = std::count_if(begin + static_cast<std::ptrdiff_t>(range.begin),
                                     begin + static_cast<std::ptrdiff_t>(range.end),
                                     [](double value) { return std::isfinite(value); });
    if (known > 1) continue;
    throw files::FileError(rows.name + ": the truth of axis " + row.axis + " is not known between samples " +
                           std::to_string(range.begin) + " and " + std::to_string(range.end) +
                           (max_signal_hz > 0.0 ? ", as far as the low-pass of denoise.max_signal_hz reaches "
                                                  "beside longer gaps and the ends"
                                                : ""));
  }
}

/// Who asks for a calibration is not to be judged by a guess.
void check_noise_of(const EvaluationRows& rows, const EvaluationOptions& options) {
  if (rows.noise_source != settings::NoiseSource::kCalibrated) return;
  if (std::ranges::none_of(options.methods, takes_noise_model)) return;
  for (const EvaluationRow& row : rows.rows) {
    if (row.noise.by != NoiseKnownBy::kNothing) continue;
    throw CLI::ValidationError(
        "--calibration", "is needed for axis " + row.axis +
                             ": noise.source is calibrated, noise.calibrations has none for the sensor (see "
                             "--sensor), and no --noise has samples left that tell its noise");
  }
}

EvaluationRows load(const EvaluateFlags& flags, EvaluationInput input, Interrupt& interrupt) {
  if (flags.input.recording == "-" || flags.input.noise == "-") interrupt.let_through();
  ProgressBar bar("reading");
  input.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    bar.show(fraction, rows);
    return !interrupt.requested();
  };
  return evaluation_rows(input);
}

int evaluate_or_stop(const EvaluateFlags& flags, Interrupt& interrupt) {
  EvaluationOptions options = options_of(flags);
  const EvaluationInput input = input_of(flags, options);
  std::optional<EvaluationFolder> folder;
  if (!flags.folder.empty()) folder.emplace(flags.folder);

  const EvaluationRows rows = load(flags, input, interrupt);
  options.range = range_of(flags, rows);
  check_truth_in(rows, options.range, options.settings.denoise.max_signal_hz);
  check_noise_of(rows, options);
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

}  // namespace

void add_evaluate(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand(
      "evaluate", "How good the estimate is where the truth is known, beside filters tuned on that truth");
  const auto flags = std::make_shared<EvaluateFlags>();
  add_evaluate_options(*command, *flags);
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
      "  gyrod evaluate drive_with_reference.csv --noise still.csv --calibration cheap_gyro.json\n"
      "  gyrod evaluate good_gyro.csv --signal-is-truth --noise cheap_gyro_still.csv --axis z --lag 0,16,32");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return evaluate_recording(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
