#include "core/denoise/correlation_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/autocorrelation.hpp"

namespace gyrod::core {
namespace {

/// The 95 % band of the plots, in standard errors.
constexpr double kPlotBand = 1.96;

/// The last lag that lies outside the wide band. Nothing where no lag beyond it is left to show that the function has cut off: one that
/// is still outside in the last quarter tails off.
template <class Outside>
std::optional<std::size_t> cut_off(std::size_t lags, const Outside& outside) {
  std::size_t last = 0;
  for (std::size_t lag = 1; lag <= lags; ++lag) {
    if (outside(lag)) last = lag;
  }
  if (lags == 0 || last > lags - lags / 4) return std::nullopt;
  return last;
}

}  // namespace

CorrelationEvidence correlation_evidence(std::span<const double> acf, std::size_t samples) noexcept {
  CorrelationEvidence evidence;
  if (acf.empty() || samples == 0) return evidence;
  evidence.lags = std::min({kEvidenceLags, acf.size() - 1, samples / 4});
  const std::size_t lags = evidence.lags;
  partial_autocorrelation(acf.first(lags + 1), std::span(evidence.pacf).first(lags));

  const auto n = static_cast<double>(samples);
  double squares = 0.0;  // of the lags before
  for (std::size_t lag = 1; lag <= lags; ++lag) {
    evidence.acf[lag - 1] = acf[lag];
    evidence.acf_band[lag - 1] = kPlotBand * std::sqrt((1.0 + 2.0 * squares) / n);
    squares += acf[lag] * acf[lag];
  }
  evidence.pacf_band = kPlotBand / std::sqrt(n);
  const double wide = kCutOffBand / kPlotBand;
  evidence.acf_cut_off = cut_off(lags, [&](std::size_t lag) {
    return std::abs(evidence.acf[lag - 1]) > wide * evidence.acf_band[lag - 1];
  });
  evidence.pacf_cut_off = cut_off(
      lags, [&](std::size_t lag) { return std::abs(evidence.pacf[lag - 1]) > wide * evidence.pacf_band; });
  return evidence;
}

ModelFamily family_by_correlations(const CorrelationEvidence& evidence) noexcept {
  if (evidence.lags == 0) return ModelFamily::kNone;
  const auto& acf = evidence.acf_cut_off;
  const auto& pacf = evidence.pacf_cut_off;
  if (!acf && !pacf) return ModelFamily::kArma;
  if (!acf) return ModelFamily::kAr;
  if (!pacf) return ModelFamily::kMa;
  if (*acf == 0 && *pacf == 0) return ModelFamily::kWhite;
  return *acf < *pacf ? ModelFamily::kMa : ModelFamily::kAr;
}

}  // namespace gyrod::core
