#include "report/allan_section.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/allan/allan_deviation.hpp"
#include "core/allan/noise_coefficients.hpp"

namespace gyrod::report {
namespace {

using core::Scheme;

/// Keys of the five coefficients, in the order of core::NoiseTerm, in the units of core::in_degrees_and_hours().
constexpr std::array<const char*, core::kNoiseTerms> kTermKeys = {"q_deg", "n_deg_per_sqrt_h", "b_dph",
                                                                  "k_dph_per_sqrt_h", "r_dph_per_h"};

Json curve_json(Scheme scheme, const std::vector<core::AllanPoint>& points) {
  const auto column = [&points](double core::AllanPoint::*field, double factor) {
    std::vector<double> values;
    for (const core::AllanPoint& point : points) values.push_back(point.*field * factor);
    return values;
  };
  return Json{{"scheme", core::name_of(scheme)},
              {"tau_s", column(&core::AllanPoint::tau_s, 1.0)},
              {"deviation_dps", column(&core::AllanPoint::deviation, kDegPerRad)},
              {"lower_dps", column(&core::AllanPoint::lower, kDegPerRad)},
              {"upper_dps", column(&core::AllanPoint::upper, kDegPerRad)},
              {"degrees_of_freedom", column(&core::AllanPoint::edf, 1.0)}};
}

Json coefficients_json(const core::NoiseCoefficients& coefficients) {
  Json all;
  for (std::size_t i = 0; i < core::kNoiseTerms; ++i) {
    const auto term = static_cast<core::NoiseTerm>(i);
    const core::Coefficient& found = coefficients[term];
    Json one{{"observable", found.observable}, {"value", nullptr}, {"standard_error", nullptr}};
    if (found.observable) {
      one["value"] = core::in_degrees_and_hours(term, found.value);
      one["standard_error"] = core::in_degrees_and_hours(term, found.standard_error);
    }
    all[kTermKeys[i]] = std::move(one);
  }
  return all;
}

Json table6_row(Scheme scheme, const std::vector<core::AllanPoint>& points) {
  return Json{{"scheme", core::name_of(scheme)},
              {"least_squares", coefficients_json(core::fit_coefficients(points))},
              {"slope", coefficients_json(core::slope_coefficients(points))},
              {"polynomial", coefficients_json(core::polynomial_coefficients(points))}};
}

/// The paper's Table 6.
Json paper_table6() {
  const auto row = [](const std::array<double, core::kNoiseTerms>& values) {
    Json all;
    for (std::size_t i = 0; i < values.size(); ++i) all[kTermKeys[i]] = values[i];
    return all;
  };
  return Json{{"raw", row({3.2e-3, 0.0127, 15.85, 6.11, 0.359})},
              {"improved", row({8.153e-4, 0.0030, 6.78, 0.922, 0.0424})}};
}

/// 0.1, 1, 10 and 100 s in samples, those of them that lie on the curve.
std::vector<std::size_t> chosen_clusters(const AxisInput& input, double longest_tau_s) {
  constexpr std::array<double, 4> kTaus = {0.1, 1.0, 10.0, 100.0};
  std::vector<std::size_t> clusters;
  for (const double tau : kTaus) {
    const auto cluster = static_cast<std::size_t>(std::max(1.0, std::round(tau * input.sample_rate_hz)));
    const bool there = static_cast<double>(cluster) * input.period_s() <= longest_tau_s * (1.0 + 1e-9);
    if (there && (clusters.empty() || cluster > clusters.back())) clusters.push_back(cluster);
  }
  return clusters;
}

Json chosen_row(Scheme scheme, const std::vector<core::AllanPoint>& points) {
  std::vector<double> values;
  for (const core::AllanPoint& point : points) values.push_back(point.deviation * kDegPerRad);
  return Json{{"scheme", core::name_of(scheme)}, {"deviation_dps", values}};
}

void add_words(const AxisInput& input, Json& section) {
  section["words"] =
      "The five terms describe a sensor's raw noise. On the output of a filter, Q, N and the slope method's "
      "R "
      "are what is made of a curve that the filter has bent at short cluster times, not properties of the "
      "sensor.";
  if (input.still) {
    section["paper"] = paper_table6();
  } else {
    section["caution"] =
        "The record moves, so that its Allan deviation is that of motion and noise together, and the "
        "coefficients are not the "
        "sensor's. Use a record at rest for them.";
  }
}

}  // namespace

Json allan_section(const AxisInput& input) {
  constexpr std::size_t kLeastPoints = 3;
  Json curves = Json::array();
  Json table6 = Json::array();
  Json chosen = Json::array();
  std::vector<double> chosen_tau_s;
  for (const Scheme scheme : core::kAllSchemes) {
    const std::vector<double>& output = input.analysis.output(scheme);
    const auto points = core::allan_deviation(output, input.sample_rate_hz);
    if (points.size() < kLeastPoints) {
      return absent(
          "the record has " + std::to_string(output.size()) +
          " samples; cluster times go up to a tenth of it, and three of them are the least for a curve.");
    }
    curves.push_back(curve_json(scheme, points));
    table6.push_back(table6_row(scheme, points));
    const auto clusters = chosen_clusters(input, points.back().tau_s);
    chosen.push_back(chosen_row(scheme, core::allan_deviation_at(output, input.sample_rate_hz, clusters)));
    chosen_tau_s.assign(clusters.begin(), clusters.end());
  }
  for (double& tau : chosen_tau_s) tau *= input.period_s();
  Json section{{"curves", std::move(curves)},
               {"table6", std::move(table6)},
               {"chosen_tau_s", std::move(chosen_tau_s)},
               {"chosen", std::move(chosen)}};
  add_words(input, section);
  return section;
}

}  // namespace gyrod::report
