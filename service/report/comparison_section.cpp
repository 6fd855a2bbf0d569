#include "report/comparison_section.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/signal/moments.hpp"
#include "report/trace.hpp"

namespace gyrod::report {
namespace {

using core::Scheme;

/// JSON key of a scheme's rates.
std::string key_of(Scheme scheme) {
  std::string key(core::name_of(scheme));
  std::ranges::replace(key, '-', '_');
  return key + "_dps";
}

double mean_absolute_deviation(std::span<const double> x) {
  const double mean = core::mean(x);
  double sum = 0.0;
  for (const double value : x) sum += std::abs(value - mean);
  return sum / static_cast<double>(x.size());
}

/// First sample of the stretch of `length` in which the slow part (what acf-emd keeps) varies most.
std::size_t liveliest(std::span<const double> slow, std::size_t length) {
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t begin = 0; begin + length <= slow.size(); begin += length) {
    const double variance = core::variance(slow.subspan(begin, length));
    if (variance > most) {
      most = variance;
      best = begin;
    }
  }
  return best;
}

Json detail_json(const AxisInput& input) {
  constexpr double kDetailS = 10.0;
  const std::size_t samples = input.record().size();
  const auto wanted = static_cast<std::size_t>(std::max(2.0, kDetailS * input.sample_rate_hz));
  const std::size_t length = std::min({wanted, samples, kTracePoints});
  const std::size_t begin = liveliest(input.analysis.output(Scheme::kAcfEmd), length);
  Json detail{{"start_s", static_cast<double>(begin) * input.period_s()}, {"step_s", input.period_s()}};
  for (const Scheme scheme : core::kAllSchemes) {
    detail[key_of(scheme)] =
        rounded(std::span(input.analysis.output(scheme)).subspan(begin, length), kDegPerRad);
  }
  return detail;
}

/// Nothing where nobody knows what the sensor did.
std::optional<SnrReference> reference_of(const AxisInput& input) {
  if (input.still) {
    const double level = core::mean(input.record());
    return SnrReference{{}, level, std::abs(level)};
  }
  std::vector<double> known;
  std::ranges::copy_if(input.truth_radps, std::back_inserter(known),
                       [](double x) { return std::isfinite(x); });
  if (known.empty()) return std::nullopt;
  return SnrReference{input.truth_radps, 0.0, std::sqrt(core::variance(known))};
}

/// The paper's Table 5.
Json paper_table5() {
  const auto row = [](double deviation, double standard, double snr) {
    return Json{{"mean_absolute_deviation_dps", deviation}, {"std_dps", standard}, {"snr_db", snr}};
  };
  return Json{{"raw", row(0.2794, 0.3520, 19.85)},
              {"direct", row(0.1534, 0.1936, 24.49)},
              {"emd", row(0.1215, 0.1535, 29.97)},
              {"improved", row(0.0731, 0.0915, 31.32)}};
}

Json table5_row(const AxisInput& input, Scheme scheme, const std::optional<SnrReference>& reference) {
  const std::vector<double>& output = input.analysis.output(scheme);
  Json row{{"scheme", core::name_of(scheme)},
           {"mean_dps", core::mean(output) * kDegPerRad},
           {"mean_absolute_deviation_dps", mean_absolute_deviation(output) * kDegPerRad},
           {"std_dps", std::sqrt(core::variance(output)) * kDegPerRad},
           {"snr_db", nullptr}};
  const auto snr = reference ? snr_db(output, *reference) : std::nullopt;
  if (snr) row["snr_db"] = *snr;
  return row;
}

}  // namespace

Json before_after_section(const AxisInput& input) {
  Json whole;
  for (const Scheme scheme : core::kAllSchemes) {
    const Trace trace = min_max_trace(input.analysis.output(scheme), input.period_s(), kTracePoints);
    whole["step_s"] = trace.step;
    whole[key_of(scheme)] = rounded(trace.values, kDegPerRad);
  }
  return Json{{"whole", std::move(whole)}, {"detail", detail_json(input)}};
}

std::optional<double> snr_db(std::span<const double> output, const SnrReference& reference) {
  std::vector<double> error;
  for (std::size_t n = 0; n < output.size(); ++n) {
    const double right = reference.truth.empty() ? reference.level : reference.truth[n];
    if (std::isfinite(right)) error.push_back(output[n] - right);
  }
  const double power = reference.truth.empty() ? core::mean_square(error) : core::variance(error);
  if (power <= 0.0 || reference.signal <= 0.0) return std::nullopt;
  return 20.0 * std::log10(reference.signal / std::sqrt(power));
}

Json table5_section(const AxisInput& input) {
  const auto reference = reference_of(input);
  Json rows = Json::array();
  for (const Scheme scheme : core::kAllSchemes) rows.push_back(table5_row(input, scheme, reference));
  Json table{{"words",
              "Mean absolute deviation is what the paper's Table 5 calls mean; see the definitions, also of "
              "the SNR."},
             {"rows", std::move(rows)}};
  if (!reference) {
    table["snr_absent"] = "the record moves and holds no true rate (truth_" + input.name +
                          "_UNIT): removed noise and removed motion look the same.";
  }
  if (input.still) table["paper"] = paper_table5();
  return table;
}

}  // namespace gyrod::report
