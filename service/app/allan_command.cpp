#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/allan_analysis.hpp"
#include "app/allan_files.hpp"
#include "app/allan_plot.hpp"
#include "app/allan_table.hpp"
#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/progress_bar.hpp"
#include "app/targets.hpp"
#include "files/output_file.hpp"
#include "files/record.hpp"

namespace gyrod::app {
namespace {

/// Made before the work, so that an output that cannot be written is known at once.
class OptionalFile {
 public:
  explicit OptionalFile(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }
  [[nodiscard]] bool wanted() const noexcept { return file_.has_value(); }
  void write(const std::string& text) {
    file_->write(text);
    file_->close();
  }

 private:
  std::optional<files::OutputFile> file_;
};

struct AllanFlags {
  std::string input;
  std::string axes = "xyz";
  std::string json;
  std::string csv;
  std::string plot;
  std::string imu_yaml;
  std::string ros_topic = "/imu0";
  bool long_tau = false;
  double confidence_percent = 100.0 * core::AllanOptions{}.confidence;
  files::RateUnit unit = files::RateUnit::kRadps;
  files::RecordOptions record;
};

/// "x,z" or "xz" to "xz". CLI11 hands text that fails to the user.
std::string check_axes(std::string& text) {
  std::string axes;
  for (const char c : text) {
    if (c == ',') continue;
    if (c < 'x' || c > 'z' || axes.find(c) != std::string::npos) {
      return "'" + text + "' given; expected some of x, y and z, e.g. z or x,y";
    }
    axes += c;
  }
  if (axes.empty()) return "'" + text + "' given; expected some of x, y and z";
  text = axes;
  return {};
}

void check_outputs(const AllanFlags& flags) {
  require_apart(std::array{NamedFile{"the input", flags.input}},
                std::array{NamedFile{"--json", flags.json}, NamedFile{"--csv", flags.csv},
                           NamedFile{"--plot", flags.plot}, NamedFile{"--imu-yaml", flags.imu_yaml}});
}

/// Then the table would be in the way.
bool to_standard_output(const AllanFlags& flags) {
  return flags.json == "-" || flags.csv == "-" || flags.plot == "-" || flags.imu_yaml == "-";
}

files::Record read_record(const AllanFlags& flags, Interrupt& interrupt) {
  // Reading from a terminal or a pipe can wait for ever.
  if (flags.input == "-") interrupt.let_through();
  ProgressBar progress("reading");
  files::RecordOptions options = flags.record;
  options.other_columns = true;
  options.reader.allow_missing_axes = flags.axes.size() < 3 || options.reader.allow_missing_axes;
  options.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    progress.show(fraction, rows);
    return !interrupt.requested();
  };
  return files::load_record(flags.input, options);
}

int allan(const AllanFlags& flags, Interrupt& interrupt) {
  check_outputs(flags);
  OptionalFile json(flags.json);
  OptionalFile csv(flags.csv);
  OptionalFile plot(flags.plot);
  OptionalFile imu_yaml(flags.imu_yaml);
  const files::Record record = read_record(flags, interrupt);
  core::AllanOptions options;
  if (flags.long_tau) options.longest_part = 0.5;
  options.confidence = 0.01 * flags.confidence_percent;
  AllanAnalysis analysis;
  {
    ProgressBar progress("Allan deviation");
    analysis = analyse_allan(record, flags.axes, options, [&](double done) {
      progress.show(done, record.size());
      return !interrupt.requested();
    });
  }
  if (interrupt.requested()) throw files::Stopped{};
  if (json.wanted()) json.write(allan_json(analysis));
  if (csv.wanted()) csv.write(allan_csv(analysis, flags.unit));
  if (plot.wanted()) plot.write(allan_svg(analysis, flags.unit));
  if (imu_yaml.wanted()) imu_yaml.write(kalibr_imu_yaml(analysis, flags.ros_topic));
  if (!to_standard_output(flags)) std::fputs(allan_table(analysis, flags.unit).c_str(), stdout);
  return kDone;
}

int allan_or_interrupted(const AllanFlags& flags, Interrupt& interrupt) {
  try {
    return allan(flags, interrupt);
  } catch (const files::Stopped&) {
    std::fprintf(stderr, "gyrod: interrupted\n");
    return kInterrupted;
  }
}

void add_inputs(CLI::App& command, AllanFlags& flags) {
  command.add_option("input", flags.input, "Recording at rest: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command
      .add_option("--rate", flags.record.sample_rate_hz,
                  "Sample rate in Hz; it holds, whatever the stamps say [from the time column]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command.add_option("--axis", flags.axes, "Axes to analyse, e.g. z or x,y [x,y,z]")
      ->type_name("AXES")
      ->transform(CLI::Validator(check_axes, ""));
  command.add_flag("--long", flags.long_tau,
                   "Cluster times up to a half of the record, not a tenth: few terms, wide bounds");
  command
      .add_option("--confidence", flags.confidence_percent,
                  "Confidence of the bounds in per cent [68.27: one standard deviation]")
      ->type_name("PERCENT")
      ->check(in_range(1.0, 99.99));
  command.add_flag("--skip-broken-rows", flags.record.reader.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
}

void add_outputs(CLI::App& command, AllanFlags& flags) {
  command
      .add_option_function<std::string>(
          "--unit", [&flags](const std::string& text) { flags.unit = *files::rate_unit_of(text); },
          "Unit of the gyro's deviation in table, CSV and plot: radps, mradps, dps, mdps, dph [radps]")
      ->type_name("UNIT")
      ->check(one_of({"radps", "mradps", "dps", "mdps", "dph"}));
  command.add_option("--json", flags.json, "All numbers, SI units; - for standard output, without the table")
      ->type_name("FILE.json");
  command.add_option("--csv", flags.csv, "The curves with bounds and fitted model")
      ->type_name("FILE.csv[.gz]");
  command.add_option("--plot", flags.plot, "The curves as a picture")->type_name("FILE.svg");
  command.add_option("--imu-yaml", flags.imu_yaml, "Noise densities and random walks as Kalibr reads them")
      ->type_name("FILE.yaml");
  command.add_option("--rostopic", flags.ros_topic, "Topic that imu.yaml names [/imu0]")->type_name("TOPIC");
}

}  // namespace

void add_allan(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("allan", "Allan deviation and noise coefficients of a still recording");
  const auto flags = std::make_shared<AllanFlags>();
  add_inputs(*command, *flags);
  add_outputs(*command, *flags);
  command->footer(
      "Prints quantization, angle random walk, bias instability, rate random walk and rate ramp of every "
      "axis in\n"
      "SI units and in degrees and hours, in continuous and in discrete time, and the deviation with its "
      "bounds.\n"
      "A term that the record does not show is \"not observable\". Accelerometers are analysed, too, where "
      "there\n"
      "are columns accel_x_mps2, accel_x_g or accel_x_mg (y and z alike). Definitions: docs/allan.md.\n\n"
      "Examples:\n"
      "  gyrod allan still.csv.gz\n"
      "  gyrod allan still.csv --rate 100 --unit dph --plot allan.svg\n"
      "  gyrod allan still.csv --json allan.json --csv allan.csv --imu-yaml imu.yaml");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return allan_or_interrupted(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
