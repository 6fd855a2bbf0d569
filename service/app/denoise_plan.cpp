#include "app/denoise_plan.hpp"

#include <CLI/CLI.hpp>

#include "app/calibration_choice.hpp"
#include "app/flags.hpp"
#include "app/options.hpp"
#include "core/denoise/record_analysis.hpp"
#include "settings/load.hpp"
#include "stream/method.hpp"

namespace gyrod::app {
namespace {

void choose_method(const DenoiseChoice& choice, settings::Settings& settings) {
  const bool papers = !choice.scheme.empty() || !choice.screening.empty() || choice.batch;
  if (papers && choice.method == "joint")
    throw CLI::ValidationError("--method",
                               "joint has no --scheme, --screening or --batch: they are method paper's");
  if (papers || choice.method == "paper") settings.denoise.method = settings::Method::kPaper;
  if (choice.method != "joint") return;
  settings.denoise.method = settings::Method::kJoint;
  if (settings.engine.lag_samples > stream::kMaxModelLagSamples) {
    throw CLI::ValidationError("--method", "joint looks ahead by " +
                                               std::to_string(stream::kMaxModelLagSamples) +
                                               " samples at most; denoise.lag_samples in " + choice.config +
                                               " is " + std::to_string(settings.engine.lag_samples));
  }
}

void choose_screening(const DenoiseChoice& choice, settings::DenoiseSettings& denoise) {
  const bool configured = !choice.config.empty() && settings::gives(choice.config, "denoise.screening");
  const bool paper = choice.screening == "paper" || (choice.batch && choice.screening.empty() && !configured);
  if (paper) denoise.screening = settings::Screening::kPaper;
  if (choice.screening == "windowed") denoise.screening = settings::Screening::kWindowed;
  if (choice.screening != "significance") return;
  denoise.screening = settings::Screening::kSignificance;
  if (denoise.sifts == 10 && denoise.boundary == core::BoundaryRule::kMirror) return;
  throw CLI::ValidationError("--screening",
                             "significance is for denoise.sifts 10 and denoise.boundary \"mirror\", for "
                             "which alone it has its noise "
                             "line; " +
                                 choice.config + " has others");
}

void choose_noise(const DenoiseChoice& choice, DenoisePlan& plan) {
  if (!choice.sensor.empty()) plan.offline.sensor = choice.sensor;
  if (choice.noise.empty()) return;
  if (choice.batch)
    throw CLI::ValidationError("--noise", "is for windows; --batch judges by the record itself");
  plan.offline.sensor = choose_calibration("--noise", choice.noise, choice.sensor).sensor;
  plan.settings.noise.calibrations = choice.noise;
  plan.settings.noise.source = settings::NoiseSource::kCalibrated;
}

}  // namespace

DenoisePlan plan_of(const DenoiseChoice& choice) {
  DenoisePlan plan{load_or_default(choice.config), choice.batch, {}, {}};
  settings::DenoiseSettings& denoise = plan.settings.denoise;
  choose_method(choice, plan.settings);
  choose_screening(choice, denoise);
  if (const auto scheme = core::scheme_of(choice.scheme)) denoise.scheme = *scheme;
  if (choice.estimate == "realtime") {
    if (!is_model_method(denoise))
      throw CLI::ValidationError("--estimate", "realtime is of method joint; method paper has none");
    plan.offline.estimate = EstimateKind::kRealtime;
  }
  choose_noise(choice, plan);
  plan.options = core::whole_record_options(denoiser_options(denoise));
  plan.options.screening.rule = denoiser_options(denoise).screening.rule;
  if (choice.models == "ar") plan.options.models = core::ModelChoice::kAr;
  return plan;
}

}  // namespace gyrod::app
