#include <cstdio>
#include <memory>
#include <optional>

#include "app/batch_denoiser.hpp"
#include "app/command.hpp"
#include "app/denoise_summary.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/offline_denoiser.hpp"
#include "app/options.hpp"
#include "app/progress_bar.hpp"
#include "core/denoise/record_analysis.hpp"
#include "files/output_file.hpp"
#include "files/recording_reader.hpp"
#include "files/recording_writer.hpp"
#include "settings/enum_names.hpp"

namespace gyrod::app {
namespace {

struct DenoiseFlags {
  std::string input;
  std::string output;
  std::string config;
  std::string summary;
  std::string scheme;     ///< empty: as configured
  std::string screening;  ///< empty: as configured; for a whole record the paper's
  std::string estimate = "denoised";
  bool deviation = false;  ///< columns of it
  bool batch = false;
  std::string models;  ///< empty: identified
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

void tell(const DenoiseFlags& flags, const stream::Counts& counts, std::uint64_t broken_rows) {
  std::fprintf(stderr, "%s: %llu samples denoised in %llu windows\n", flags.output.c_str(),
               static_cast<unsigned long long>(counts.published - counts.passed_through),
               static_cast<unsigned long long>(counts.windows));
  const auto note = [](std::uint64_t count, const std::string& what) {
    if (count > 0) std::fprintf(stderr, "  %llu %s\n", static_cast<unsigned long long>(count), what.c_str());
  };
  note(counts.passed_through, "samples kept as they were: too few in a row to denoise");
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    note(counts.rejected[i], "samples refused and kept as they were: " +
                                 std::string(name_of(static_cast<stream::RejectReason>(i))));
  }
  note(counts.missing, "samples missing from the input");
  note(broken_rows, "broken rows left out");
}

/// What is to be done: the configuration with the flags on top.
struct Plan {
  settings::Settings settings;
  bool whole_record = false;
  core::DenoiserOptions options;  ///< of a whole record
  EstimateKind estimate = EstimateKind::kDenoised;
};

/// @throws settings::SettingsError, CLI::ValidationError
Plan plan_of(const DenoiseFlags& flags) {
  Plan plan{load_or_default(flags.config), flags.batch, {}, EstimateKind::kDenoised};
  if (flags.estimate == "realtime") {
    if (flags.batch || !is_model_method(plan.settings.denoise))
      throw CLI::ValidationError("--estimate",
                                 "realtime needs a model method (denoise.method), without --batch");
    plan.estimate = EstimateKind::kRealtime;
  }
  settings::DenoiseSettings& denoise = plan.settings.denoise;
  if (!flags.scheme.empty()) denoise.scheme = *core::scheme_of(flags.scheme);
  const bool paper = flags.screening == "paper" || (flags.batch && flags.screening.empty());
  if (paper) denoise.screening = settings::Screening::kPaper;
  if (flags.screening == "windowed") denoise.screening = settings::Screening::kWindowed;
  if (flags.screening == "significance") {
    denoise.screening = settings::Screening::kSignificance;
    if (denoise.sifts != 10 || denoise.boundary != core::BoundaryRule::kMirror) {
      throw CLI::ValidationError(
          "--screening",
          "significance is for denoise.sifts 10 and denoise.boundary \"mirror\", for which alone it has "
          "its noise line; " +
              flags.config + " has others");
    }
  }
  plan.options = core::whole_record_options(denoiser_options(denoise));
  plan.options.screening.rule = denoiser_options(denoise).screening.rule;
  if (flags.models == "ar") plan.options.models = core::ModelChoice::kAr;
  return plan;
}

/// @return what became of the samples, or nothing if it was interrupted
std::optional<stream::Counts> denoise_all(files::RecordingReader& reader, RowHandler& rows,
                                          DenoiseSummary& summary, const Plan& plan, Interrupt& interrupt) {
  if (plan.whole_record) {
    BatchDenoiser denoiser(plan.settings, plan.options, rows, summary);
    if (!denoise_rows(reader, denoiser, interrupt)) return std::nullopt;
    return denoiser.counts();
  }
  OfflineDenoiser denoiser(plan.settings, rows, summary, plan.estimate);
  if (!denoise_rows(reader, denoiser, interrupt)) return std::nullopt;
  return denoiser.counts();
}

DenoiseSummary::Source source_of(const DenoiseFlags& flags, const Plan& plan, std::uint64_t broken_rows) {
  const bool ar = !plan.whole_record || plan.options.models == core::ModelChoice::kAr;
  return {
      .input = flags.input,
      .output = flags.output,
      .method = plan.whole_record ? "paper" : std::string(settings::name_of(plan.settings.denoise.method)),
      .estimate = flags.estimate,
      .scheme = std::string(core::name_of(plan.settings.denoise.scheme)),
      .whole_record = plan.whole_record,
      .screening = std::string(settings::name_of(plan.settings.denoise.screening)),
      .models = ar ? "ar" : "identified",
      .broken_rows = broken_rows};
}

int denoise(const DenoiseFlags& flags, Interrupt& interrupt) {
  // Reading from a terminal or a pipe can wait for ever.
  if (flags.input == "-") interrupt.let_through();
  if (flags.summary == flags.output) throw CLI::ValidationError("--summary", "is the same file as --output");
  const Plan plan = plan_of(flags);
  files::RecordingReader reader(flags.input, flags.recording.options);
  files::RecordingWriter writer(flags.output, reader.header(), flags.deviation);
  std::optional<files::OutputFile> summary_file;
  if (!flags.summary.empty()) summary_file.emplace(flags.summary);

  RowsToFile rows(writer);
  DenoiseSummary summary;
  const auto counts = denoise_all(reader, rows, summary, plan, interrupt);
  if (!counts) {
    std::fprintf(stderr, "gyrod: interrupted\n");
    return kInterrupted;
  }

  writer.close();
  if (summary_file) {
    summary_file->write(summary.json(source_of(flags, plan, reader.broken_rows()), *counts));
    summary_file->close();
  }
  tell(flags, *counts, reader.broken_rows());
  return kDone;
}

constexpr const char* kFooter =
    "The output has the input's columns, names and units; only the angular rates change, and --std adds\n"
    "gyro_std_x_UNIT, gyro_std_y_UNIT, gyro_std_z_UNIT. Columns:\n"
    "  gyro_x_UNIT, gyro_y_UNIT, gyro_z_UNIT   UNIT: radps, mradps, dps, mdps, dph\n"
    "  timestamp_s or stamp_ns (also _us, _ms) time of measurement; without it --rate applies\n"
    "  sample or sequence                      number of the sample; without it rows are counted\n"
    "  anything else                           passes through\n"
    "Samples that are refused (nan, out of range, duplicate, ...) stay as they are and are counted.\n"
    "Without --batch the result is the daemon's for the same samples, bit for bit. OUT appears when it is "
    "complete.\n\n"
    "Schemes:\n"
    "  raw       nothing is changed\n"
    "  direct    time-series model and Kalman filter on the record itself\n"
    "  emd       decomposed, noise modes dropped\n"
    "  acf-emd   decomposed, noise and mixed modes dropped\n"
    "  improved  decomposed, noise modes dropped, mixed ones modelled and filtered: the method itself\n\n"
    "Examples:\n"
    "  gyrod denoise drive.csv -o denoised.csv\n"
    "  gyrod denoise drive.csv.gz -o denoised.csv.gz --summary summary.json\n"
    "  gyrod denoise still.csv -o direct.csv --batch --scheme direct";

void add_method_options(CLI::App& command, DenoiseFlags& flags) {
  command
      .add_option("--scheme", flags.scheme,
                  "raw, direct, emd, acf-emd or improved: see below [as configured, else improved]")
      ->type_name("NAME")
      ->check(one_of({core::kSchemeNames.begin(), core::kSchemeNames.end()}));
  command
      .add_option("--screening", flags.screening,
                  "windowed, paper or significance [as configured, else windowed; with --batch paper]")
      ->type_name("RULE")
      ->check(one_of({"windowed", "paper", "significance"}));
  CLI::Option* batch =
      command.add_flag("--batch", flags.batch, "The whole record at once, as the paper does, not in windows");
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
  command->add_option("--config", flags->config, "Configuration file: its groups denoise and limits")
      ->type_name("FILE");
  command->add_option("--summary", flags->summary, "Write counts and noise figures as JSON")
      ->type_name("FILE.json");
  command->add_flag("--std", flags->deviation,
                    "Add columns with the estimated standard deviation of what is left of the noise; 0 where "
                    "unknown, empty where a sample was refused");
  command
      ->add_option(
          "--estimate", flags->estimate,
          "denoised: with the configured look-ahead; realtime: without any, model methods only [denoised]")
      ->type_name("KIND")
      ->check(one_of({"denoised", "realtime"}));
  add_method_options(*command, *flags);
  flags->recording.add_to(*command);
  command->footer(kFooter);
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return denoise(*flags, interrupt); }; });
}

}  // namespace gyrod::app
