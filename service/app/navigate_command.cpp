#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "app/angle_units.hpp"
#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/navigation_comparison.hpp"
#include "app/navigation_rates.hpp"
#include "app/navigation_report.hpp"
#include "app/progress_bar.hpp"
#include "app/targets.hpp"
#include "files/column_names.hpp"
#include "files/file_error.hpp"
#include "files/output_file.hpp"
#include "settings/load.hpp"

namespace gyrod::app {
namespace {

struct NavigateFlags {
  std::string input;
  std::string config;
  std::string truth;
  std::string json;
  std::string csv;
  std::vector<std::string> schemes;
  std::optional<double> rate_hz;
  std::optional<std::size_t> delay_samples;
  double truth_offset_s = 0.0;
  double latitude_deg = 45.0;
  double longitude_deg = 0.0;
  double height_m = 0.0;
  bool still = false;
  bool whole_record = false;
  bool skip_broken_rows = false;
  NavigationOptions options;
};

files::Record load(const NavigateFlags& flags, Interrupt& interrupt) {
  ProgressBar progress("reading");
  files::RecordOptions options;
  options.reader.skip_broken_rows = flags.skip_broken_rows;
  options.sample_rate_hz = flags.rate_hz;
  options.other_columns = true;
  options.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    progress.show(fraction, rows);
    return !interrupt.requested();
  };
  return files::load_record(flags.input, options);
}

core::GeodeticPosition reference_of(const NavigateFlags& flags) {
  return {kRadPerDeg * flags.latitude_deg, kRadPerDeg * flags.longitude_deg, flags.height_m};
}

/// --truth names a file if there is one of that name, else a prefix.
std::optional<files::NavigationTruth> truth_of(const NavigateFlags& flags, const files::Record& record) {
  if (flags.still) return std::nullopt;
  const core::GeodeticPosition reference = reference_of(flags);
  const bool looks_like_file = flags.truth.find_first_of("./") != std::string::npos;
  if (looks_like_file || std::filesystem::is_regular_file(flags.truth))
    return files::load_truth(flags.truth, record, {flags.truth_offset_s, reference});
  const auto prefix = flags.truth.empty() ? std::nullopt : std::optional(flags.truth);
  auto truth = files::truth_columns(record, prefix, reference);
  if (truth) {
    for (double& time_s : truth->truth.time_s) time_s += flags.truth_offset_s;
    return truth;
  }
  throw files::FileError(
      record.name +
      ": no truth to compare with; expected reference columns (gt_q_w.., gt_p_x_m.., "
      "ref_lat_deg.., ref_vn_mps.., see --help), --truth FILE, or --still if the sensor did not move; "
      "found " +
      files::names_of(record.others));
}

/// Every scheme at its own stamps; the denoised ones again as they come, late by the lag.
std::vector<NavigationRun> runs_of(const std::vector<std::string>& schemes,
                                   const std::vector<NavigatedRates>& rates, std::size_t delay_samples) {
  std::vector<NavigationRun> runs;
  for (std::size_t k = 0; k < schemes.size(); ++k) {
    NavigationRun run{schemes[k], {rates[k][0], rates[k][1], rates[k][2]}, 0};
    runs.push_back(run);
    const bool at_once = comes_at_once(schemes[k]);
    if (at_once || delay_samples == 0) continue;
    run.delay_samples = delay_samples;
    runs.push_back(run);
  }
  return runs;
}

void check_outputs(const NavigateFlags& flags) {
  require_apart(std::array{NamedFile{"the input", flags.input}, NamedFile{"--truth", flags.truth}},
                std::array{NamedFile{"--json", flags.json}, NamedFile{"--csv", flags.csv}});
  if (flags.still && !flags.truth.empty())
    throw CLI::ValidationError("--still", "and --truth exclude one another");
}

int navigate(NavigateFlags flags, Interrupt& interrupt) {
  if (flags.input == "-") interrupt.let_through();
  check_outputs(flags);
  const settings::Settings settings = load_or_default(flags.config);
  if (flags.schemes.empty()) flags.schemes = navigated_by_default(settings, flags.whole_record);
  check_navigated(flags.schemes, settings, flags.whole_record);
  std::optional<files::OutputFile> json_file;
  std::optional<files::OutputFile> csv_file;
  if (!flags.json.empty()) json_file.emplace(flags.json);
  if (!flags.csv.empty()) csv_file.emplace(flags.csv);

  const files::Record record = load(flags, interrupt);
  const files::Accelerometer accelerometer = files::accelerometer_of(record);
  const auto truth = truth_of(flags, record);
  flags.options.reference = reference_of(flags);
  flags.options.keep_series = csv_file.has_value();
  std::vector<NavigatedRates> rates;
  for (const std::string& scheme : flags.schemes) {
    if (interrupt.requested()) throw files::Stopped{};
    rates.push_back(navigated_rates(scheme, record, settings, flags.whole_record));
  }
  const std::size_t delay = flags.delay_samples.value_or(settings.engine.lag_samples);
  const NavigationResult result =
      compare_navigation(record, accelerometer, runs_of(flags.schemes, rates, delay), truth, flags.options);

  std::fputs(navigation_text(record, result).c_str(), stdout);
  if (json_file) {
    json_file->write(navigation_json(record, result));
    json_file->close();
  }
  if (csv_file) {
    write_navigation_csv(result, *csv_file);
    csv_file->close();
  }
  return kDone;
}

int navigate_or_stop(const NavigateFlags& flags, Interrupt& interrupt) {
  try {
    return navigate(flags, interrupt);
  } catch (const files::Stopped&) {
    std::fprintf(stderr, "gyrod: interrupted\n");
    return kInterrupted;
  }
}

void add_input(CLI::App& command, NavigateFlags& flags) {
  command.add_option("input", flags.input, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command.add_option("--rate", flags.rate_hz, "Sample rate in Hz; needed where the file has no time column")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command.add_option("--config", flags.config, "Configuration file: its groups denoise, noise and limits")
      ->type_name("FILE");
  command.add_flag("--skip-broken-rows", flags.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
  command
      .add_option(
          "--schemes", flags.schemes,
          "raw, direct, emd, acf-emd, improved (method paper), joint, realtime (method joint with and "
          "without look-ahead), separated by commas [raw,joint,realtime,improved; with --whole-record "
          "raw,acf-emd,improved]")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(one_of(navigated_names()));
  command.add_flag("--whole-record", flags.whole_record,
                   "Denoise the record in one piece, as the paper does, not by windows");
  command
      .add_option("--delay-samples", flags.delay_samples,
                  "Samples by which denoised rates come late in the rows without lag compensation;\n"
                  "0: no such rows [denoise.lag_samples]")
      ->type_name("N")
      ->check(whole_in_range(0, 1000000));
}

void add_truth(CLI::App& command, NavigateFlags& flags) {
  command
      .add_option("--truth", flags.truth,
                  "Prefix of the reference's columns, or a file with columns and times of its own\n"
                  "[the only reference in the recording]")
      ->type_name("PREFIX|FILE");
  command.add_option("--truth-offset", flags.truth_offset_s, "Added to the truth's times, s [0]")
      ->type_name("S")
      ->check(in_range(-1e6, 1e6));
  command.add_flag("--still", flags.still, "The sensor was at rest all the time: that is the truth");
}

void add_start(CLI::App& command, NavigateFlags& flags) {
  static const std::map<std::string, BiasSource> sources = {{"auto", BiasSource::kAutomatic},
                                                            {"level", BiasSource::kLevelling},
                                                            {"truth", BiasSource::kTruth},
                                                            {"none", BiasSource::kNone}};
  NavigationOptions& options = flags.options;
  auto* start = command
                    .add_option("--start", options.starts_s,
                                "Start times, s since the recording's first sample, separated by commas")
                    ->type_name("S,...")
                    ->delimiter(',')
                    ->allow_extra_args(false);
  command
      .add_option("--starts", options.start_count,
                  "Number of starts, spread evenly over the times where one is possible [5]")
      ->type_name("N")
      ->check(whole_in_range(1, 1000))
      ->excludes(start);
  command.add_option("--duration", options.duration_s, "Length of each navigation, s [50]")
      ->type_name("S")
      ->check(in_range(0.1, 1e5));
  command
      .add_option("--level-seconds", options.level_s,
                  "Rest before each start that roll, pitch and biases are taken from, s [10]")
      ->type_name("S")
      ->check(in_range(0.1, 1e5));
  command
      .add_option_function<std::string>(
          "--bias", [&options](const std::string& text) { options.bias = sources.at(text); },
          "Biases to take off. level: means of that rest; truth: what fits the whole truth best;\n"
          "none; auto: truth where that has attitudes, else level [auto]")
      ->type_name("FROM")
      ->check(one_of({"auto", "level", "truth", "none"}));
  command
      .add_option("--heading", options.heading_deg,
                  "Heading of the x axis at the start, deg, where the truth has no attitude\n"
                  "[fitted to the truth's velocity, else 0]")
      ->type_name("DEG")
      ->check(in_range(-360, 360));
  command.add_option("--latitude", flags.latitude_deg, "Where it was, if the truth does not say [45]")
      ->type_name("DEG")
      ->check(in_range(-89, 89));
  command.add_option("--longitude", flags.longitude_deg, "[0]")->type_name("DEG")->check(in_range(-360, 360));
  command.add_option("--height", flags.height_m, "Above the ellipsoid [0]")
      ->type_name("M")
      ->check(in_range(-1000, 20000));
}

}  // namespace

void add_navigate(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand(
      "navigate", "Strapdown navigation from raw and denoised rates, compared with the truth");
  const auto flags = std::make_shared<NavigateFlags>();
  add_input(*command, *flags);
  add_truth(*command, *flags);
  add_start(*command, *flags);
  command->add_option("--json", flags->json, "Write all figures as JSON")->type_name("FILE.json");
  command->add_option("--csv", flags->csv, "Write the errors sample by sample; gzip if it ends in .gz")
      ->type_name("FILE.csv[.gz]");
  command->footer(
      "The recording needs gyro_{x,y,z}_UNIT as for denoise and accel_{x,y,z}_UNIT (mps2, g, mg). Truth, "
      "with any\n"
      "prefix P that ends in _ and is the same for all its columns:\n"
      "  Pq_w, Pq_x, Pq_y, Pq_z                      attitude, body to a level frame with z up\n"
      "  Proll_deg, Ppitch_deg, Pheading_deg|yaw_deg attitude, body to north-east-down\n"
      "  Plat_deg, Plon_deg, Ph_m                    position on WGS-84\n"
      "  Pp_x_m.. or Ppos_x_m..                      position in the level frame with z up\n"
      "  Pvn_mps, Pve_mps, Pvd_mps|vu_mps            velocity\n"
      "Rows named 'SCHEME, N late' use the denoised rates as if they were current. Denoising takes off white "
      "noise,\n"
      "which integration averages out anyway: expect little gain, and loss where a scheme takes motion for "
      "noise\n"
      "(docs/navigation.md).\n\n"
      "Examples:\n"
      "  gyrod navigate static.csv --rate 100 --still\n"
      "  gyrod navigate handheld.csv.gz --truth gt --starts 5 --json errors.json\n"
      "  gyrod navigate drive.csv.gz --truth gnss.csv --truth-offset -0.1 --start 20");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return navigate_or_stop(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
