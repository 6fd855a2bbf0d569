#include "app/navigation_rates.hpp"

#include <CLI/CLI.hpp>

#include "app/record_denoiser.hpp"
#include "core/denoise/scheme.hpp"
#include "stream/method.hpp"

namespace gyrod::app {
namespace {

constexpr std::string_view kJointName = "joint";
constexpr std::string_view kRealtimeName = "realtime";

}  // namespace

std::vector<std::string> navigated_names() {
  std::vector<std::string> names(core::kSchemeNames.begin(), core::kSchemeNames.end());
  names.emplace_back(kJointName);
  names.emplace_back(kRealtimeName);
  return names;
}

std::vector<std::string> navigated_by_default(const settings::Settings& settings, bool whole_record) {
  if (whole_record || settings.engine.lag_samples > stream::kMaxModelLagSamples)
    return {"raw", "acf-emd", "improved"};
  return {"raw", std::string(kJointName), std::string(kRealtimeName), "improved"};
}

bool comes_at_once(std::string_view name) noexcept {
  return name == core::name_of(core::Scheme::kRaw) || name == kRealtimeName;
}

void check_navigated(const std::vector<std::string>& names, const settings::Settings& settings,
                     bool whole_record) {
  for (const std::string& name : names) {
    if (name != kJointName && name != kRealtimeName) continue;
    if (whole_record)
      throw CLI::ValidationError("--schemes", name + " and --whole-record exclude one another");
    if (settings.engine.lag_samples <= stream::kMaxModelLagSamples) continue;
    throw CLI::ValidationError("--schemes", name + " looks ahead by " +
                                                std::to_string(stream::kMaxModelLagSamples) +
                                                " samples at most; denoise.lag_samples is " +
                                                std::to_string(settings.engine.lag_samples));
  }
}

NavigatedRates navigated_rates(const std::string& name, const files::Record& record,
                               const settings::Settings& settings, bool whole_record) {
  if (const auto scheme = core::scheme_of(name))
    return denoise_record(record, settings, *scheme, whole_record);
  return estimate_record(record, settings,
                         name == kRealtimeName ? EstimateKind::kRealtime : EstimateKind::kDenoised);
}

}  // namespace gyrod::app
