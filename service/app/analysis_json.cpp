#include "app/analysis_json.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace gyrod::app {
namespace {

using nlohmann::ordered_json;

std::vector<double> list(std::span<const double> values, std::size_t count) {
  const auto first = values.first(count);
  return {first.begin(), first.end()};
}

const char* name_of(core::ImfClass imf_class) noexcept {
  constexpr std::array<const char*, 3> kNames = {"noise", "mixed", "signal"};
  return kNames[static_cast<std::size_t>(imf_class)];
}

ordered_json cut_off_json(const std::optional<std::size_t>& lag) {
  return lag ? ordered_json(*lag) : ordered_json("tails_off");
}

ordered_json family_json(const core::FamilyBest& best) {
  if (!best.tried) return nullptr;
  return {{"p", best.p}, {"q", best.q}, {"bic", best.bic}};
}

}  // namespace

ordered_json model_json(const core::ModelFigures& model) {
  if (model.family == core::ModelFamily::kNone) return nullptr;
  ordered_json json = {{"family", core::name_of(model.family)},
                       {"p", model.ar_order},
                       {"q", model.ma_order},
                       {"a", list(model.ar_coefficients, model.ar_order)},
                       {"b", list(model.ma_coefficients, model.ma_order)},
                       {"innovation_variance_rad2ps2", model.innovation_variance}};
  if (model.tested) {
    json["adequate"] = model.adequate;
    json["ljung_box_p"] = model.ljung_box_p;
  }
  json["filtered"] = model.used;
  return json;
}

ordered_json imfs_json(const core::WindowReport& report) {
  ordered_json imfs = ordered_json::array();
  for (std::size_t i = 0; i < report.imf_count; ++i) {
    const core::ImfFigures& figures = report.imf[i];
    ordered_json imf = {{"imf", i + 1},
                        {"class", name_of(figures.imf_class)},
                        {"pcc", figures.pcc},
                        {"acf_variance", figures.acf_variance},
                        {"acf_concentration", figures.acf_concentration},
                        {"mean_period_samples", figures.mean_period_samples},
                        {"energy_rad2ps2", figures.energy},
                        {"excess", figures.excess},
                        {"noise_excess_low", figures.noise_excess_low},
                        {"noise_excess_high", figures.noise_excess_high},
                        {"noise_probability", figures.noise_probability}};
    if (figures.imf_class == core::ImfClass::kMixed) imf["model"] = model_json(figures.model);
    imfs.push_back(std::move(imf));
  }
  return imfs;
}

ordered_json identification_json(const core::Identification& identification) {
  const core::CorrelationEvidence& evidence = identification.evidence;
  const core::Whiteness& residuals = identification.residuals;
  const core::ArmaModel& model = identification.model;
  return {{"family", core::name_of(model.family())},
          {"p", model.p},
          {"q", model.q},
          {"a", list(model.a, model.p)},
          {"a_standard_error", list(model.a_error, model.p)},
          {"b", list(model.b, model.q)},
          {"b_standard_error", list(model.b_error, model.q)},
          {"innovation_variance_rad2ps2", model.innovation_variance},
          {"roots_pulled_in", model.status == core::ArStatus::kDamped},
          {"acf_and_pacf",
           {{"family", core::name_of(identification.by_correlations)},
            {"acf_cuts_off_after", cut_off_json(evidence.acf_cut_off)},
            {"pacf_cuts_off_after", cut_off_json(evidence.pacf_cut_off)},
            {"acf", list(evidence.acf, evidence.lags)},
            {"acf_band", list(evidence.acf_band, evidence.lags)},
            {"pacf", list(evidence.pacf, evidence.lags)},
            {"pacf_band", evidence.pacf_band}}},
          {"best_ar", family_json(identification.best_ar)},
          {"best_ma", family_json(identification.best_ma)},
          {"best_arma", family_json(identification.best_arma)},
          {"residuals",
           {{"adequate", residuals.adequate},
            {"ljung_box_q", residuals.ljung_box_q},
            {"degrees_of_freedom", residuals.degrees_of_freedom},
            {"ljung_box_p", residuals.p_value},
            {"lags", residuals.lags},
            {"lags_outside_95_percent_band", residuals.lags_outside},
            {"within_bands", residuals.within_bands}}}};
}

}  // namespace gyrod::app
