#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/abandonable.hpp"
#include "app/analysis_json.hpp"
#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "app/targets.hpp"
#include "app/version.hpp"
#include "core/denoise/record_analysis.hpp"
#include "files/file_error.hpp"
#include "files/number_text.hpp"
#include "files/output_file.hpp"
#include "files/rate_unit.hpp"
#include "files/record.hpp"

namespace gyrod::app {
namespace {

struct DecomposeFlags {
  std::string input;
  std::string output;
  std::string axis;  ///< empty: all that the file has
  std::string summary;
  std::optional<files::RateUnit> unit;  ///< nothing: the file's
  core::EmdOptions emd;
  std::optional<double> rate_hz;
  bool allow_missing_axes = false;
  bool skip_broken_rows = false;
};

/// "dir/out.csv.gz" for axis x: "dir/out_x.csv.gz".
std::string name_for_axis(const std::string& path, const char* axis) {
  const auto slash = path.rfind('/');
  const auto begin = slash == std::string::npos ? 0 : slash + 1;
  const auto dot = path.find('.', begin + 1);  // a leading dot belongs to the name
  const auto end = dot == std::string::npos ? path.size() : dot;
  return path.substr(0, end) + "_" + axis + path.substr(end);
}

struct Target {
  std::size_t axis = 0;
  std::string path;
};

/// Axes to decompose, and the files that they go to.
std::vector<Target> targets_of(const DecomposeFlags& flags, const files::Record& record) {
  std::vector<Target> targets;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const bool asked = flags.axis.empty() || flags.axis == stream::kAxisNames[axis];
    if (!asked) continue;
    if (!record.gyro_radps[axis].empty()) {
      const bool own_name = !flags.axis.empty();
      targets.push_back(
          {axis, own_name ? flags.output : name_for_axis(flags.output, stream::kAxisNames[axis])});
    } else if (!flags.axis.empty()) {
      throw files::FileError(record.name + ": has no gyro_" + flags.axis + " column, which --axis asks for");
    }
  }
  return targets;
}

/// @return null if it was interrupted
std::shared_ptr<const files::Record> load(const DecomposeFlags& flags, Interrupt& interrupt) {
  ProgressBar progress("reading");
  files::RecordOptions options;
  options.reader.allow_missing_axes = flags.allow_missing_axes || !flags.axis.empty();
  options.reader.skip_broken_rows = flags.skip_broken_rows;
  options.sample_rate_hz = flags.rate_hz;
  options.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    progress.show(fraction, rows);
    return !interrupt.requested();
  };
  try {
    return std::make_shared<const files::Record>(files::load_record(flags.input, options));
  } catch (const files::Stopped&) {
    return nullptr;
  }
}

/// @return false if it was interrupted
bool write_columns(files::OutputFile& file, const files::Record& record, const core::RecordAnalysis& analysis,
                   files::RateUnit unit, Interrupt& interrupt) {
  constexpr std::size_t kLookUpEvery = 4096;
  std::string line = "time_s";
  for (std::size_t i = 1; i <= analysis.imfs.size(); ++i) line += ",imf_" + std::to_string(i);
  file.write(line + ",residue\n");
  for (std::size_t n = 0; n < record.size(); ++n) {
    if (n % kLookUpEvery == 0 && interrupt.requested()) return false;
    line.clear();
    files::append_number(line, record.time_s[n]);
    for (const auto& imf : analysis.imfs) {
      line += ',';
      files::append_number(line, files::from_radps(imf[n], unit));
    }
    line += ',';
    files::append_number(line, files::from_radps(analysis.residue[n], unit));
    line += '\n';
    file.write(line);
  }
  return true;
}

nlohmann::ordered_json axis_json(const Target& target, const core::RecordAnalysis& analysis) {
  nlohmann::ordered_json identified = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < analysis.mixed.size(); ++i) {
    nlohmann::ordered_json one = {{"imf", analysis.report.j + i + 1}};
    one.update(identification_json(analysis.mixed[i]));
    identified.push_back(std::move(one));
  }
  return {{"output", target.path},
          {"j", analysis.report.j},
          {"k", analysis.report.k},
          {"mean_radps", analysis.report.mean},
          {"noise_floor_radps", analysis.report.noise_floor},
          {"imfs", imfs_json(analysis.report)},
          {"identification", std::move(identified)}};
}

std::string summary_of(const DecomposeFlags& flags, const files::Record& record, files::RateUnit unit,
                       const nlohmann::ordered_json& axes) {
  const nlohmann::ordered_json summary = {{"gyrod_version", version()},
                                          {"input", flags.input},
                                          {"unit", files::spelling_of(unit)},
                                          {"sample_rate_hz", record.sample_rate_hz},
                                          {"samples", record.size()},
                                          {"first_stamp_s", record.first_stamp_s},
                                          {"rows",
                                           {{"read", record.counts.rows},
                                            {"broken", record.counts.broken},
                                            {"refused", record.counts.refused},
                                            {"bridged", record.counts.bridged},
                                            {"left_out_by_gaps", record.counts.left_out}}},
                                          {"sifts", flags.emd.sifts},
                                          {"boundary", "mirror"},
                                          {"screening", "paper"},
                                          {"axes", axes}};
  return summary.dump(2) + "\n";
}

int interrupted() {
  std::fprintf(stderr, "gyrod: interrupted, no file was written\n");
  return kInterrupted;
}

void tell(const files::Record& record) {
  const auto note = [](std::uint64_t count, const char* what) {
    if (count > 0) std::fprintf(stderr, "  %llu %s\n", static_cast<unsigned long long>(count), what);
  };
  note(record.counts.broken, "broken rows left out");
  note(record.counts.refused, "samples refused (not finite, out of range, duplicate, out of order)");
  note(record.counts.bridged, "samples of short gaps bridged by a straight line");
  note(record.counts.left_out, "samples left out: only the longest stretch without a long gap is decomposed");
}

int decompose(const DecomposeFlags& flags, Interrupt& interrupt) {
  if (flags.input == "-") interrupt.let_through();
  if (flags.output == "-" && flags.axis.empty())
    throw CLI::ValidationError("--output",
                               "is standard output, which holds one axis; expected --axis beside it");
  require_apart(std::array{NamedFile{"the input", flags.input}},
                std::array{NamedFile{"--output", flags.output}, NamedFile{"--summary", flags.summary}});
  const std::shared_ptr<const files::Record> record = load(flags, interrupt);
  if (!record) return interrupted();
  if (flags.input == "-") interrupt.hold();
  const files::RateUnit unit = flags.unit.value_or(record->header.unit);
  core::DenoiserOptions options = core::whole_record_options();
  options.emd = flags.emd;

  const std::vector<Target> targets = targets_of(flags, *record);
  std::vector<std::unique_ptr<files::OutputFile>> outputs;
  outputs.reserve(targets.size());
  for (const Target& target : targets) outputs.push_back(std::make_unique<files::OutputFile>(target.path));
  std::optional<files::OutputFile> summary_file;
  if (!flags.summary.empty()) summary_file.emplace(flags.summary);

  nlohmann::ordered_json axes = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto analysis = while_wanted([&interrupt] { return !interrupt.requested(); },
                                       [record, axis = targets[i].axis, options] {
                                         return core::analyse_record(record->gyro_radps[axis], options);
                                       });
    if (!analysis || !write_columns(*outputs[i], *record, *analysis, unit, interrupt)) return interrupted();
    axes[stream::kAxisNames[targets[i].axis]] = axis_json(targets[i], *analysis);
    std::fprintf(stderr,
                 "%s: %zu IMFs of %zu samples, by the paper's rule %zu noise, %zu mixed, the rest signal\n",
                 targets[i].path.c_str(), analysis->imfs.size(), record->size(), analysis->report.j,
                 analysis->report.k - analysis->report.j);
  }
  for (const auto& output : outputs) output->close();
  if (summary_file) {
    summary_file->write(summary_of(flags, *record, unit, axes));
    summary_file->close();
  }
  tell(*record);
  return kDone;
}

void add_options(CLI::App& command, DecomposeFlags& flags) {
  command.add_option("input", flags.input, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command
      .add_option(
          "-o,--output", flags.output,
          "One file an axis, OUT_x.csv and so on; gzip if it ends in .gz. With --axis this file; - for\n"
          "standard output")
      ->type_name("OUT.csv[.gz]")
      ->required();
  command.add_option("--axis", flags.axis, "x, y or z alone [all that the file has]")
      ->type_name("AXIS")
      ->check(one_of({"x", "y", "z"}));
  command.add_option("--summary", flags.summary, "Write the screening's figures and the models as JSON")
      ->type_name("FILE.json");
  command
      .add_option_function<std::string>(
          "--unit", [&flags](const std::string& text) { flags.unit = files::rate_unit_of(text); },
          "Unit of all columns but time_s: radps, mradps, dps, mdps, dph [as in the input]")
      ->type_name("UNIT")
      ->check(one_of({"radps", "mradps", "dps", "mdps", "dph"}));
  command.add_option("--sifts", flags.emd.sifts, "Sifting steps a mode, 1 to 100 [10]")
      ->type_name("N")
      ->check(whole_in_range(1, 100));
  command
      .add_option("--rate", flags.rate_hz,
                  "Sample rate in Hz, whatever the stamps say; needed where the file has no time column")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command.add_flag("--allow-missing-axes", flags.allow_missing_axes,
                   "Take a file without one or two of the axes");
  command.add_flag("--skip-broken-rows", flags.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
}

}  // namespace

void add_decompose(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand("decompose", "Take a recording apart into its modes (EMD)");
  const auto flags = std::make_shared<DecomposeFlags>();
  add_options(*command, *flags);
  command->footer(
      "Columns: time_s (from the first sample), imf_1 (the fastest) to imf_n, residue. They add up to the "
      "angular rate\n"
      "to rounding. The record is decomposed as a whole; of a record with long gaps the longest stretch. The "
      "summary\n"
      "holds what the paper's screening says of each IMF: class (noise, mixed, signal), correlation with the "
      "record,\n"
      "ACF variance, mean period, energy, j and k, and the model of each mixed IMF with its evidence.\n\n"
      "Examples:\n"
      "  gyrod decompose still.csv -o imfs.csv --summary imfs.json      writes imfs_x.csv, imfs_y.csv, "
      "imfs_z.csv\n"
      "  gyrod decompose still.csv.gz -o z.csv.gz --axis z --rate 100");
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return decompose(*flags, interrupt); }; });
}

}  // namespace gyrod::app
