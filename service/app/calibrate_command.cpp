#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "app/angle_units.hpp"
#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/noise_calibrator.hpp"
#include "app/progress_bar.hpp"
#include "app/targets.hpp"
#include "core/noise/noise_units.hpp"
#include "files/output_file.hpp"
#include "files/record.hpp"
#include "settings/noise_calibration.hpp"

namespace gyrod::app {
namespace {

constexpr double kSqrtSecondsPerSqrtHour = 60.0;

struct CalibrateFlags {
  std::string input;
  std::string output;
  std::vector<double> density_dps;     ///< of a data sheet; one for all axes or three
  std::vector<double> arw_deg;         ///< likewise
  std::optional<double> bandwidth_hz;  ///< of the sensor's low-pass, with one of these
  std::optional<double> from_s;
  std::optional<double> to_s;
  files::RecordOptions record;
  CalibrationOptions calibration;

  [[nodiscard]] bool from_data_sheet() const { return !density_dps.empty() || !arw_deg.empty(); }
};

void check_flags(const CalibrateFlags& flags) {
  if (flags.from_data_sheet() == !flags.input.empty())
    throw CLI::ValidationError("expected either a recording or --noise-density or --arw");
  if (!flags.density_dps.empty() && !flags.arw_deg.empty())
    throw CLI::ValidationError("--noise-density and --arw say the same; expected one of them");
  for (const auto& [flag, values] :
       {std::pair{"--noise-density", &flags.density_dps}, {"--arw", &flags.arw_deg}}) {
    if (values->size() == 2)
      throw CLI::ValidationError(flag, "2 values given; expected one for all axes, or three for x, y, z");
  }
  if (flags.from_data_sheet() && !flags.record.sample_rate_hz)
    throw CLI::ValidationError("--rate is missing; expected the sensor's sample rate in Hz");
  if (flags.from_data_sheet() && (flags.from_s || flags.to_s || flags.calibration.all_still))
    throw CLI::ValidationError("--from, --to and --all-still are for a recording");
  if (flags.bandwidth_hz && !flags.from_data_sheet())
    throw CLI::ValidationError("--bandwidth is for --noise-density or --arw: a recording shows it");
  if (flags.from_s && flags.to_s && *flags.from_s >= *flags.to_s) {
    throw CLI::ValidationError("--from", fmt::format("{:g} is not before --to {:g}; nothing lies between",
                                                     *flags.from_s, *flags.to_s));
  }
}

/// White noise, behind the sensor's low-pass where that is told: a data sheet knows no other colour.
settings::NoiseCalibration from_data_sheet(const CalibrateFlags& flags) {
  const bool density = !flags.density_dps.empty();
  const std::vector<double>& values = density ? flags.density_dps : flags.arw_deg;
  const double rate = *flags.record.sample_rate_hz;
  settings::NoiseCalibration calibration;
  if (!flags.calibration.sensor_id.empty()) calibration.sensor_id = flags.calibration.sensor_id;
  calibration.sample_rate_hz = rate;
  for (std::size_t a = 0; a < calibration.models.size(); ++a) {
    const double value = values[values.size() == 1 ? 0 : a] * kRadPerDeg;
    calibration.models[a] = density ? core::from_noise_density(value, rate)
                                    : core::from_angle_random_walk(value / kSqrtSecondsPerSqrtHour, rate);
    if (flags.bandwidth_hz)
      calibration.models[a] = core::behind_low_pass(calibration.models[a], *flags.bandwidth_hz, rate);
  }
  calibration.origin.source = fmt::format(
      "{} {}", density ? "noise density, deg/s/sqrt(Hz):" : "ARW, deg/sqrt(h):", fmt::join(values, " "));
  if (flags.bandwidth_hz)
    calibration.origin.source += fmt::format("; bandwidth {:g} Hz", *flags.bandwidth_hz);
  return calibration;
}

files::Record read_record(const CalibrateFlags& flags, Interrupt& interrupt) {
  // Reading from a terminal or a pipe can wait for ever.
  if (flags.input == "-") interrupt.let_through();
  ProgressBar progress("reading");
  files::RecordOptions options = flags.record;
  options.other_columns = true;
  options.progress = [&](std::optional<double> fraction, std::uint64_t rows) {
    progress.show(fraction, rows);
    return !interrupt.requested();
  };
  return files::load_record(flags.input, options);
}

/// What became of rows that did not take part, on standard error.
void tell_left_out(const files::Record& record, const NoiseCalibrationRun& run) {
  const auto note = [](std::uint64_t count, const char* what) {
    if (count > 0) std::fprintf(stderr, "  %llu %s\n", static_cast<unsigned long long>(count), what);
  };
  note(record.counts.broken, "broken rows left out");
  note(record.counts.refused, "samples refused (not finite, out of range, duplicate, out of order)");
  note(record.counts.bridged, "samples of short gaps bridged by a straight line");
  note(record.counts.left_out, "samples left out: only the longest stretch without a long gap is looked at");
  if (!run.accelerometer_trouble.empty())
    std::fprintf(stderr, "  rest is judged without the accelerometer: %s\n",
                 run.accelerometer_trouble.c_str());
}

NoiseCalibrationRun from_recording(const CalibrateFlags& flags, Interrupt& interrupt) {
  const files::Record record = read_record(flags, interrupt);
  CalibrationOptions options = flags.calibration;
  if (flags.from_s) options.from_s = *flags.from_s;
  if (flags.to_s) options.to_s = *flags.to_s;
  NoiseCalibrationRun run;
  {
    ProgressBar progress("looking for rest");
    run = calibrate_noise(record, options, [&](double done) {
      progress.show(done, record.size());
      return !interrupt.requested();
    });
  }
  tell_left_out(record, run);
  return run;
}

int calibrate(const CalibrateFlags& flags, Interrupt& interrupt) {
  check_flags(flags);
  require_apart(std::array{NamedFile{"the input", flags.input}},
                std::array{NamedFile{"--output", flags.output}});
  files::OutputFile output(flags.output);
  std::string text;
  settings::NoiseCalibration calibration;
  if (flags.from_data_sheet()) {
    calibration = from_data_sheet(flags);
  } else {
    NoiseCalibrationRun run = from_recording(flags, interrupt);
    text = stretches_text(run) + shared_lines_text(run);
    calibration = std::move(run.calibration);
  }
  output.write(settings::calibration_text(calibration));
  output.close();
  if (flags.output == "-") return kDone;
  const std::string whose = calibration.sensor_id ? "sensor " + *calibration.sensor_id : "all sensors";
  text += calibration_table(calibration) + "Written to " + flags.output + ", for " + whose + ".\n";
  std::fputs(text.c_str(), stdout);
  return kDone;
}

int calibrate_or_interrupted(const CalibrateFlags& flags, Interrupt& interrupt) {
  try {
    return calibrate(flags, interrupt);
  } catch (const files::Stopped&) {
    std::fprintf(stderr, "gyrod: interrupted\n");
    return kInterrupted;
  }
}

void add_recording(CLI::App& command, CalibrateFlags& flags) {
  command
      .add_option("input", flags.input,
                  "Recording with the sensor at rest: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]");
  command
      .add_option("--rate", flags.record.sample_rate_hz,
                  "Sample rate in Hz; it holds, whatever the stamps say [from the time column]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
  command.add_option("--from", flags.from_s, "Look only from this time on, s into the recording")
      ->type_name("S")
      ->check(in_range(0.0, 1e9));
  command.add_option("--to", flags.to_s, "Look only up to this time")
      ->type_name("S")
      ->check(in_range(0.0, 1e9));
  command
      .add_option("--least-still", flags.calibration.least_still_s,
                  "Rest that must be found, s; never fewer than 2000 samples [30]")
      ->type_name("S")
      ->check(in_range(0.0, 1e9));
  command.add_flag("--all-still", flags.calibration.all_still,
                   "Take all of it as still, on your word; what moves counts as noise then");
  command.add_flag("--allow-missing-axes", flags.record.reader.allow_missing_axes,
                   "Take a file without one or two of the axes");
  command.add_flag("--skip-broken-rows", flags.record.reader.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
}

void add_data_sheet(CLI::App& command, CalibrateFlags& flags) {
  command
      .add_option("--noise-density", flags.density_dps,
                  "Instead of a recording: rms noise density of the data sheet in deg/s/sqrt(Hz)")
      ->type_name("D[,Y,Z]")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(in_range(1e-9, 1e3));
  command
      .add_option("--arw", flags.arw_deg,
                  "Instead of a recording: angle random walk of the data sheet in deg/sqrt(h)")
      ->type_name("N[,Y,Z]")
      ->delimiter(',')
      ->expected(1, 3)
      ->check(in_range(1e-9, 1e4));
  command
      .add_option("--bandwidth", flags.bandwidth_hz,
                  "With one of these: -3 dB frequency of the sensor's own low-pass (DLPF, LPF1) in Hz [half "
                  "of --rate]")
      ->type_name("HZ")
      ->check(in_range(1e-3, 1e6));
}

}  // namespace

void add_calibrate(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand(
      "calibrate", "Measure a sensor's own noise in a still recording, for noise.calibrations");
  const auto flags = std::make_shared<CalibrateFlags>();
  add_recording(*command, *flags);
  add_data_sheet(*command, *flags);
  command->add_option("-o,--output", flags->output, "Where to write the calibration; - for standard output")
      ->type_name("FILE.json")
      ->required();
  command
      ->add_option("--sensor", flags->calibration.sensor_id,
                   "Sensor id that it is for [every sensor without one of its own]")
      ->type_name("ID")
      ->check(sensor_id());
  command->footer(
      "Finds where the sensor is at rest, engine off, and fits level and colour of its noise there. A "
      "minute\n"
      "is enough for the level to 1 %; ten are better for the colour. Prints what was found in deg/s and in\n"
      "the units of data sheets: docs/noise.md.\n\n"
      "Examples:\n"
      "  gyrod calibrate still.csv.gz -o front.json --sensor front\n"
      "  gyrod calibrate drive.csv --from 0 --to 90 -o front.json\n"
      "  gyrod calibrate --noise-density 0.05 --rate 100 -o adis16405.json\n"
      "  gyrod calibrate --noise-density 0.005 --bandwidth 42 --rate 200 -o mpu6050.json");
  command->callback([&chosen, flags] {
    chosen = [flags](Interrupt& interrupt) { return calibrate_or_interrupted(*flags, interrupt); };
  });
}

}  // namespace gyrod::app
