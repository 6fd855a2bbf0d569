#include "app/rival_families.hpp"

#include <cmath>
#include <cstddef>

#include "report/json.hpp"

namespace gyrod::app {
namespace {

using core::Rival;

constexpr std::size_t kButterworth = 2;  // in rival_families()

std::string order_of(Rival rival) {
  const std::string name(core::name_of(rival));
  const bool has_order = name.back() >= '1' && name.back() <= '4';
  return has_order ? "order " + std::string(1, name.back()) + ", " : "";
}

}  // namespace

const std::vector<RivalFamily>& rival_families() {
  static const std::vector<RivalFamily> all = {
      {"raw", EstimatorKind::kUntouched, {Rival::kRaw}},
      {"bias removed", EstimatorKind::kUntouched, {Rival::kBiasRemoved}},
      {kTunedName,
       EstimatorKind::kFilter,
       {Rival::kButterworth1, Rival::kButterworth2, Rival::kButterworth4}},
      {"exponential average", EstimatorKind::kFilter, {Rival::kExponential}},
      {"moving average", EstimatorKind::kFilter, {Rival::kMovingAverage}},
      {"Savitzky-Golay", EstimatorKind::kFilter, {Rival::kSavitzkyGolay}},
      {"alpha-beta", EstimatorKind::kFilter, {Rival::kAlphaBeta}},
      {"One-Euro", EstimatorKind::kFilter, {Rival::kOneEuro}},
      {"zero-phase Butterworth",
       EstimatorKind::kBound,
       {Rival::kZeroPhase1, Rival::kZeroPhase2, Rival::kZeroPhase4}},
  };
  return all;
}

const RivalFamily& tuned_butterworths() { return rival_families()[kButterworth]; }

std::string tuning_words(const core::RivalSetting& setting, double rate_hz) {
  const double parameter = setting.parameter;
  const core::RivalParameter kind = core::parameter_of(setting.rival);
  const bool smooths = kind != core::RivalParameter::kNone && kind != core::RivalParameter::kOffset;
  if (smooths && parameter == core::pass_through_of(setting.rival)) return "passes all";
  switch (kind) {
    case core::RivalParameter::kNone:
      return "";
    case core::RivalParameter::kOffset:
      return "bias " + report::number_text(parameter, 3) + " deg/s";
    case core::RivalParameter::kCutoff:
      return order_of(setting.rival) + "cut-off " + report::number_text(parameter * rate_hz, 3) + " Hz" +
             (setting.second > 0.0 ? " + " + report::number_text(setting.second * rate_hz, 2) + " Hz a step"
                                   : "");
    case core::RivalParameter::kShare:
      return "share " + report::number_text(parameter, 3);
    case core::RivalParameter::kSamples:
      return std::to_string(std::llround(parameter)) + " samples";
    case core::RivalParameter::kIndex:
      return "tracking index " + report::number_text(parameter, 3);
  }
  return "";
}

std::vector<core::TunedRival> tuned(const RivalFamily& family, const core::TuningCase& on,
                                    const std::vector<std::size_t>& bounds) {
  std::vector<core::TunedRival> best;
  for (const Rival rival : family.rivals) {
    const auto now = core::tune(rival, on, bounds);
    if (best.empty()) best = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].rmse < best[i].rmse) best[i] = now[i];
    }
  }
  return best;
}

}  // namespace gyrod::app
