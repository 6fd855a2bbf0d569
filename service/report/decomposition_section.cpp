#include "report/decomposition_section.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/signal/autocorrelation.hpp"
#include "core/signal/moments.hpp"
#include "report/trace.hpp"

namespace gyrod::report {
namespace {

constexpr std::string_view name_of(core::ImfClass imf_class) noexcept {
  switch (imf_class) {
    case core::ImfClass::kNoise:
      return "noise";
    case core::ImfClass::kMixed:
      return "mixed";
    case core::ImfClass::kSignal:
      return "signal";
  }
  return "";
}

/// [Yang2019] Table 1.
constexpr std::string_view correlation_word(double pcc) noexcept {
  const double size = pcc < 0.0 ? -pcc : pcc;
  if (size < 0.20) return "very weak";
  if (size < 0.40) return "weak";
  if (size < 0.70) return "moderate";
  return size < 0.90 ? "strong" : "very strong";
}

Json trace_json(std::span<const double> series, double period_s, std::size_t most) {
  const Trace trace = min_max_trace(series, period_s, most);
  return Json{{"step_s", trace.step}, {"values_dps", rounded(trace.values, kDegPerRad)}};
}

Json imf_json(const AxisInput& input, std::size_t index, core::Autocorrelation& autocorrelation) {
  const core::ImfFigures& figures = input.analysis.report.imf[index];
  const std::vector<double>& imf = input.analysis.imfs[index];
  std::vector<double> acf(imf.size());
  autocorrelation.acf(imf, acf);
  const Trace acf_trace = min_max_trace(acf, input.period_s(), kRowPoints);
  return Json{{"imf", index + 1},
              {"class", name_of(figures.imf_class)},
              {"mean_period_s", figures.mean_period_samples * input.period_s()},
              {"std_dps", std::sqrt(figures.energy) * kDegPerRad},
              {"pcc", figures.pcc},
              {"correlation", correlation_word(figures.pcc)},
              {"acf_variance", figures.acf_variance},
              {"acf_concentration", figures.acf_concentration},
              {"excess", figures.excess},
              {"noise_excess_low", figures.noise_excess_low},
              {"noise_excess_high", figures.noise_excess_high},
              {"noise_probability", figures.noise_probability},
              {"trace", trace_json(imf, input.period_s(), kRowPoints)},
              {"acf", Json{{"step_s", acf_trace.step}, {"values", rounded(acf_trace.values)}}}};
}

std::string why_not_decomposed(const AxisInput& input) {
  const auto record = input.record();
  if (record.size() < core::Denoiser::kMinSamples) {
    return "the record has " + std::to_string(record.size()) + " samples, and " +
           std::to_string(core::Denoiser::kMinSamples) + " are the least that are decomposed.";
  }
  return "the record does not oscillate on this axis, so that there is no IMF in it.";
}

/// "IMF 1 to 6", "IMF 7", "no IMF".
std::string imf_range(std::size_t first, std::size_t last) {
  if (first > last) return "no IMF";
  if (first == last) return "IMF " + std::to_string(first);
  return "IMF " + std::to_string(first) + " to " + std::to_string(last);
}

std::string partition_words(const AxisInput& input) {
  const core::WindowReport& report = input.analysis.report;
  std::string words = std::to_string(report.imf_count) +
                      " IMFs and a residue. j = " + std::to_string(report.j) +
                      ", k = " + std::to_string(report.k) + ": noise is " + imf_range(1, report.j) +
                      ", mixed " + imf_range(report.j + 1, report.k) + ", signal " +
                      imf_range(report.k + 1, report.imf_count) + " and the residue.";
  if (input.still) words += " The paper's record: 19 IMFs, j = 6, k = 11.";
  return words;
}

std::string evidence_words(const core::Identification& found) {
  const auto one = [](const char* name, const std::optional<std::size_t>& cut_off) {
    return std::string(name) +
           (cut_off ? " cuts off after " + std::to_string(*cut_off) : std::string(" tails off"));
  };
  if (found.evidence.lags == 0) return "too short";
  return one("ACF", found.evidence.acf_cut_off) + ", " + one("PACF", found.evidence.pacf_cut_off) + ": " +
         std::string(core::name_of(found.by_correlations));
}

std::string model_words(const core::ArmaModel& model) {
  std::string words(core::name_of(model.family()));
  switch (model.family()) {
    case core::ModelFamily::kAr:
      return words + "(" + std::to_string(model.p) + ")";
    case core::ModelFamily::kMa:
      return words + "(" + std::to_string(model.q) + ")";
    case core::ModelFamily::kArma:
      return words + "(" + std::to_string(model.p) + ", " + std::to_string(model.q) + ")";
    case core::ModelFamily::kNone:
    case core::ModelFamily::kWhite:
      break;
  }
  return words;
}

std::string verdict(const core::Identification& found) {
  if (found.model.family() == core::ModelFamily::kNone) {
    return found.model.status == core::ArStatus::kConstant ? "no model: it does not vary"
                                                           : "no model: too short";
  }
  if (found.residuals.lags == 0) return "too short to test";
  std::string words = found.residuals.adequate ? "white" : "not white by Ljung-Box";
  words += found.residuals.within_bands ? "" : ", not by the paper's criterion";
  if (found.model.status == core::ArStatus::kDamped) words += "; roots pulled inside the unit circle";
  return words;
}

Json family_bic(const core::FamilyBest& best) { return best.tried ? Json(best.bic) : Json(nullptr); }

Json model_row(const std::string& series, const core::Identification& found) {
  const core::ArmaModel& model = found.model;
  const auto first = [](const auto& values, std::size_t count) {
    return std::vector<double>(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  };
  return Json{{"series", series},
              {"model", model_words(model)},
              {"ar", first(model.a, model.p)},
              {"ar_error", first(model.a_error, model.p)},
              {"ma", first(model.b, model.q)},
              {"ma_error", first(model.b_error, model.q)},
              {"noise_std_dps", std::sqrt(model.innovation_variance) * kDegPerRad},
              {"evidence", evidence_words(found)},
              {"bic_ar", family_bic(found.best_ar)},
              {"bic_ma", family_bic(found.best_ma)},
              {"bic_arma", family_bic(found.best_arma)},
              {"ljung_box_q", found.residuals.ljung_box_q},
              {"degrees_of_freedom", found.residuals.degrees_of_freedom},
              {"p_value", found.residuals.p_value},
              {"lags_outside", found.residuals.lags_outside},
              {"lags", found.residuals.lags},
              {"verdict", verdict(found)}};
}

}  // namespace

Json record_section(const AxisInput& input) {
  const auto record = input.record();
  const auto [least, most] = std::ranges::minmax(record);
  return Json{{"mean_dps", core::mean(record) * kDegPerRad},
              {"std_dps", std::sqrt(core::variance(record)) * kDegPerRad},
              {"least_dps", least * kDegPerRad},
              {"most_dps", most * kDegPerRad},
              {"trace", trace_json(record, input.period_s(), kTracePoints)}};
}

Json decomposition_section(const AxisInput& input) {
  const core::WindowReport& report = input.analysis.report;
  if (report.imf_count == 0) return absent(why_not_decomposed(input));
  core::Autocorrelation autocorrelation(input.record().size());
  Json imfs = Json::array();
  for (std::size_t i = 0; i < report.imf_count; ++i) imfs.push_back(imf_json(input, i, autocorrelation));
  return Json{{"words", partition_words(input)},
              {"j", report.j},
              {"k", report.k},
              {"acf_variance_threshold", core::ScreeningOptions{}.acf_variance},
              {"imfs", std::move(imfs)},
              {"residue", Json{{"trace", trace_json(input.analysis.residue, input.period_s(), kRowPoints)}}}};
}

Json model_section(const AxisInput& input) {
  const core::RecordAnalysis& analysis = input.analysis;
  if (analysis.report.imf_count == 0) return absent(why_not_decomposed(input));
  Json rows = Json::array();
  for (std::size_t i = 0; i < analysis.mixed.size(); ++i) {
    rows.push_back(model_row("IMF " + std::to_string(analysis.report.j + 1 + i), analysis.mixed[i]));
  }
  rows.push_back(model_row("record (scheme direct)", analysis.direct));
  std::string words = "BIC takes the model; ACF and PACF say what the paper's Table 2 would.";
  if (analysis.mixed.empty()) words += " There is no mixed IMF here: nothing to model but the record.";
  if (input.still) {
    words +=
        " The paper's mixed IMFs 7 to 11 were AR(4), AR(6), AR(4), AR(6), AR(4). A smooth IMF is nearly "
        "predictable, so that on a long record even tiny departures fail the test of the residuals.";
  }
  return Json{{"words", words}, {"rows", std::move(rows)}};
}

}  // namespace gyrod::report
