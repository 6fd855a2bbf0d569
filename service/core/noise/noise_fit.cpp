#include "core/noise/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/signal/levinson.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Bins that bias, its straight line and their leakage through the Hann taper reach.
constexpr std::size_t kBiasBins = 3;
/// Bins that stand in for them.
constexpr std::size_t kStandIn = 4;
/// Bins on either side that the least level is averaged over: 17 bins of 20 segments have a standard error of 6 %.
constexpr std::size_t kHalfBand = 8;
/// A spectrum with a hole, e.g. of a filtered signal, still gets a white part: a filter needs one.
constexpr double kLeastWhite = 1e-4;

/// Mean of power[k] cos(2 pi k lag / N) over a full turn: the autocovariance at that lag.
double autocovariance(const NoiseSpectrum& power, std::size_t lag) noexcept {
  double sum = 0.0;
  for (std::size_t k = 0; k < kNoiseBins; ++k) {
    const double weight = k == 0 || k + 1 == kNoiseBins ? 1.0 : 2.0;
    const std::size_t turn = (k * lag) % kNoiseSegment;
    sum += weight * power[k] * portable_sine_cosine(static_cast<double>(turn) / kNoiseSegment).cosine;
  }
  return sum / static_cast<double>(kNoiseSegment);
}

double least_level(const NoiseSpectrum& power) noexcept {
  constexpr std::size_t kBand = 2 * kHalfBand + 1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first + kBand <= kNoiseBins; ++first) {
    const auto begin = power.begin() + static_cast<std::ptrdiff_t>(first);
    least = std::min(least, std::accumulate(begin, begin + kBand, 0.0) / static_cast<double>(kBand));
  }
  return least;
}

NoiseSpectrum without_bias(const NoiseSpectrum& power) noexcept {
  NoiseSpectrum result = power;
  const auto first = power.begin() + kBiasBins;
  const double level = std::accumulate(first, first + kStandIn, 0.0) / static_cast<double>(kStandIn);
  std::fill_n(result.begin(), kBiasBins, level);
  return result;
}

}  // namespace

std::optional<NoiseModel> fit_noise(const NoiseSpectrum& power) noexcept {
  const NoiseSpectrum rest = without_bias(power);
  const double variance = autocovariance(rest, 0);
  if (!(variance > 0.0) || !std::isfinite(variance)) return std::nullopt;
  return fit_noise(rest, std::max(0.5 * least_level(rest), kLeastWhite * variance));
}

std::optional<NoiseModel> fit_noise(const NoiseSpectrum& power, double white) noexcept {
  const double variance = autocovariance(power, 0);
  if (!(variance > 0.0) || !std::isfinite(variance)) return std::nullopt;
  NoiseSpectrum rest = power;
  for (double& bin : rest) bin = std::max(bin - white, 0.0);
  std::array<double, kMaxNoiseColour + 1> lags{};
  for (std::size_t lag = 0; lag < lags.size(); ++lag) lags[lag] = autocovariance(rest, lag);
  NoiseModel model = white_noise(white);
  model.colour_order = kMaxNoiseColour;
  const double innovation = levinson(lags, model.colour);
  // What was cut off at zero would otherwise add to the level.
  if (lags[0] > 0.0) model.colour_variance = innovation * (variance - white) / lags[0];
  return is_usable(model) ? std::optional(model) : std::nullopt;
}

}  // namespace gyrod::core
