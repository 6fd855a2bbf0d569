#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "app/batch_denoiser.hpp"
#include "app/calibration_choice.hpp"
#include "app/command.hpp"
#include "app/denoise_plan.hpp"
#include "app/denoise_summary.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/offline_denoiser.hpp"
#include "app/progress_bar.hpp"
#include "app/targets.hpp"
#include "files/output_file.hpp"
#include "files/recording_reader.hpp"
#include "files/recording_writer.hpp"
#include "settings/enum_names.hpp"
#include "settings/unused_keys.hpp"

namespace gyrod::app {
namespace {

struct DenoiseFlags {
  std::string input;
  std::string output;
  std::string summary;
  bool deviation = false;  ///< columns of it
  DenoiseChoice choice;
  RecordingFlags recording;
};

/// Denoised rows go to the file; refused ones stay as they are.
class RowsToFile final : public RowHandler {
 public:
  explicit RowsToFile(files::RecordingWriter& writer) : writer_(writer) {}
  void on_denoised(const std::string& row_text, const std::array<double, stream::kAxes>& rate_radps,
                   const std::array<double, stream::kAxes>& rate_std_radps) override {
    writer_.write(row_text, rate_radps, rate_std_radps);
  }
  void on_refused(const std::string& row_text) override { writer_.write_unchanged(row_text); }

 private:
  files::RecordingWriter& writer_;
};

/// @return false if it was interrupted
template <class Denoiser>
bool denoise_rows(files::RecordingReader& reader, Denoiser& denoiser, Interrupt& interrupt) {
  constexpr std::uint64_t kLookUpEvery = 256;  // a few windows: well under a tenth of a second
  ProgressBar progress("denoising");
  files::RecordingRow row;
  while (reader.next(row)) {
    denoiser.push(row);
    if (reader.rows() % kLookUpEvery != 0) continue;
    if (interrupt.requested()) return false;
    progress.show(reader.progress(), reader.rows());
  }
  if (interrupt.requested()) return false;  // the end may have come because of the same Ctrl-C
  denoiser.finish();
  return !interrupt.requested();
}

void tell(const DenoiseSummary::Source& source, const DenoiseSummary& summary, const stream::Counts& counts) {
  std::fprintf(stderr, "%s: %llu samples denoised in %llu windows, method %s, %s\n", source.output.c_str(),
               static_cast<unsigned long long>(counts.published - counts.passed_through),
               static_cast<unsigned long long>(counts.windows), source.method.c_str(),
               summary.noise_words().c_str());
  for (const std::string& note : summary.notes(source, counts)) std::fprintf(stderr, "  %s\n", note.c_str());
}

/// What became of the recording.
struct Outcome {
  stream::Counts counts;
  std::string calibration_note;
};

/// @return nothing if it was interrupted
std::optional<Outcome> denoise_all(files::RecordingReader& reader, RowHandler& rows, DenoiseSummary& summary,
                                   const DenoisePlan& plan, Interrupt& interrupt) {
  if (plan.whole_record) {
    BatchDenoiser denoiser(plan.settings, plan.options, rows, summary,
                           [&interrupt] { return !interrupt.requested(); });
    if (!denoise_rows(reader, denoiser, interrupt)) return std::nullopt;
    return Outcome{denoiser.counts(), ""};
  }
  OfflineDenoiser denoiser(plan.settings, rows, summary, plan.offline);
  if (!denoise_rows(reader, denoiser, interrupt)) return std::nullopt;
  const auto* calibration = denoiser.calibration();
  const bool used = calibration != nullptr && summary.sample_rate_hz() > 0.0;
  return Outcome{denoiser.counts(), used ? other_rate_note(*calibration, summary.sample_rate_hz()) : ""};
}

DenoiseSummary::Source source_of(const DenoiseFlags& flags, const DenoisePlan& plan,
                                 const files::RecordingReader& reader, const Outcome& outcome,
                                 double sample_rate_hz) {
  const bool ar = !plan.whole_record || plan.options.models == core::ModelChoice::kAr;
  const bool joint = plan.settings.denoise.method == settings::Method::kJoint;
  return {
      .input = flags.input,
      .output = flags.output,
      .method = std::string(settings::name_of(plan.settings.denoise.method)),
      .estimate = flags.choice.estimate,
      .scheme = std::string(core::name_of(plan.settings.denoise.scheme)),
      .whole_record = plan.whole_record,
      .screening = std::string(settings::name_of(plan.settings.denoise.screening)),
      .models = ar ? "ar" : "identified",
      .broken_rows = reader.broken_rows(),
      .rate_note = flags.recording.rate_note(reader),
      .calibration_note = outcome.calibration_note,
      .band_note = joint ? settings::unused_band(plan.settings.denoise.max_signal_hz, sample_rate_hz) : ""};
}

int denoise(const DenoiseFlags& flags, Interrupt& interrupt) {
  // Reading from a terminal or a pipe can wait for ever.
  if (flags.input == "-") interrupt.let_through();
  require_apart(std::array{NamedFile{"the input", flags.input}, NamedFile{"--noise", flags.choice.noise},
                           NamedFile{"--config", flags.choice.config}},
                std::array{NamedFile{"--output", flags.output}, NamedFile{"--summary", flags.summary}});
  const DenoisePlan plan = plan_of(flags.choice);
  files::RecordingReader reader(flags.input, flags.recording.options);
  files::RecordingWriter writer(flags.output, reader.header(), flags.deviation);
  std::optional<files::OutputFile> summary_file;
  if (!flags.summary.empty()) summary_file.emplace(flags.summary);

  RowsToFile rows(writer);
  DenoiseSummary summary;
  const auto outcome = denoise_all(reader, rows, summary, plan, interrupt);
  if (!outcome) {
    std::fprintf(stderr, "gyrod: interrupted, no file was written\n");
    return kInterrupted;
  }

  writer.close();
  const DenoiseSummary::Source source = source_of(flags, plan, reader, *outcome, summary.sample_rate_hz());
  if (summary_file) {
    summary_file->write(summary.json(source, outcome->counts));
    summary_file->close();
  }
  tell(source, summary, outcome->counts);
  return outcome->counts.published > 0 ? kDone : kIncomplete;
}

constexpr const char* kFooter =
    "The output has the input's columns, names and units; only the angular rates change, and --std adds\n"
    "gyro_std_x_UNIT, gyro_std_y_UNIT, gyro_std_z_UNIT. Columns:\n"
    "  gyro_x_UNIT, gyro_y_UNIT, gyro_z_UNIT   UNIT: radps, mradps, dps, mdps, dph\n"
    "  timestamp_s or stamp_ns (also _us, _ms) time of measurement; without it --rate applies\n"
    "  sample or sequence                      number of the sample; without it rows are counted\n"
    "  anything else                           passes through\n"
    "Samples that are refused (nan, out of range, duplicate, ...) stay as they are and are counted.\n"
    "Where all are, the exit code is 6.\n"
    "Without --batch the result is the daemon's for the same samples, bit for bit. OUT appears when it is "
    "complete.\n\n"
    "Schemes of method paper, which --scheme, --screening and --batch imply:\n"
    "  raw       nothing is changed\n"
    "  direct    time-series model and Kalman filter on the record itself\n"
    "  emd       decomposed, noise modes dropped\n"
    "  acf-emd   decomposed, noise and mixed modes dropped\n"
    "  improved  decomposed, noise modes dropped, mixed ones modelled and filtered: the paper's method\n\n"
    "Examples:\n"
    "  gyrod denoise drive.csv -o denoised.csv\n"
    "  gyrod denoise drive.csv.gz -o denoised.csv.gz --summary summary.json\n"
    "  gyrod denoise drive.csv -o denoised.csv --noise front.json --std\n"
    "  gyrod denoise still.csv -o direct.csv --batch --scheme direct";

void add_noise_options(CLI::App& command, DenoiseChoice& flags) {
  command
      .add_option("--noise", flags.noise,
                  "Calibration of the sensor's noise, by gyrod calibrate [as configured, else learned]")
      ->type_name("FILE.json");
  command
      .add_option("--sensor", flags.sensor,
                  "Whose recording it is: finds its calibration, and what noise.state_file remembers")
      ->type_name("ID")
      ->check(sensor_id());
}

void add_accelerometer_option(CLI::App& command, RecordingFlags& flags) {
  command
      .add_flag(
          "--accelerometer", flags.options.accelerometer,
          "Let the recording's accelerometer (accel_x_UNIT ...; mps2, g, mg) help to tell rest, as that of a "
          "ROS 2 topic does")
      ->excludes(command.get_option("--batch"));
}

void add_method_options(CLI::App& command, DenoiseChoice& flags) {
  command
      .add_option(
          "--method", flags.method,
          "joint: the two-speed estimator; paper: EMD and AR-Kalman filters [as configured, else joint]")
      ->type_name("NAME")
      ->check(one_of({"joint", "paper"}));
  command
      .add_option("--scheme", flags.scheme,
                  "Method paper with raw, direct, emd, acf-emd or improved: see below [as configured, else "
                  "improved]")
      ->type_name("NAME")
      ->check(one_of({core::kSchemeNames.begin(), core::kSchemeNames.end()}));
  command
      .add_option("--screening", flags.screening,
                  "Method paper with windowed, paper or significance [as configured, else windowed, or paper "
                  "with --batch]")
      ->type_name("RULE")
      ->check(one_of({"windowed", "paper", "significance"}));
  CLI::Option* batch = command.add_flag(
      "--batch", flags.batch, "Method paper on the whole record at once, as the paper does, not in windows");
  command
      .add_option("--models", flags.models,
                  "With --batch: identified (AR, MA or ARMA) or ar, as in windows [identified]")
      ->type_name("KIND")
      ->check(one_of({"identified", "ar"}))
      ->needs(batch);
}

}  // namespace

void add_denoise(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand("denoise", "Denoise a recording");
  const auto flags = std::make_shared<DenoiseFlags>();
  command->add_option("input", flags->input, "Recording: CSV, plain or gzip; - for standard input")
      ->type_name("IN.csv[.gz]")
      ->required();
  command
      ->add_option("-o,--output", flags->output,
                   "Denoised recording; gzip if it ends in .gz; - for standard output")
      ->type_name("OUT.csv[.gz]")
      ->required();
  command
      ->add_option("--config", flags->choice.config,
                   "Configuration file: its groups denoise, noise and limits")
      ->type_name("FILE");
  command->add_option("--summary", flags->summary, "Write counts and noise figures as JSON")
      ->type_name("FILE.json");
  command->add_flag("--std", flags->deviation,
                    "Add columns with the estimated standard deviation of what is left of the noise; 0 where "
                    "unknown, empty where a sample was refused");
  command
      ->add_option(
          "--estimate", flags->choice.estimate,
          "denoised: with the configured look-ahead; realtime: without any, method joint only [denoised]")
      ->type_name("KIND")
      ->check(one_of({"denoised", "realtime"}));
  add_method_options(*command, flags->choice);
  add_noise_options(*command, flags->choice);
  add_accelerometer_option(*command, flags->recording);
  flags->recording.add_to(*command);
  command->footer(kFooter);
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return denoise(*flags, interrupt); }; });
}

}  // namespace gyrod::app
