#include "core/joint/noise_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

constexpr double kColourPole = 0.25;
/// Of ln(power / noise's) where there is noise alone: of three windows, and what the shape misses.
constexpr double kBandDeviation = 0.1;
/// Share of bands that hold motion, and the mean of ln(power / noise's) there.
constexpr double kMotionBands = 0.4;
constexpr double kMotionExcess = 0.6;
/// The same where all of it shakes, and how likely that is: what is believed of the level is not given up for it.
/// Source: docs/decisions/0007, "A car that shakes is not a louder sensor".
constexpr double kShakingExcess = 2.0;
constexpr double kShaking = 0.2;
/// Of ln(level), where it is believed.
constexpr double kBelievedDeviation = 0.3;
constexpr double kMeanTilt = 0.3;
/// However far a band lies below the noise, that is no more unlikely.
constexpr double kLeastLogLikelihood = -70.0;

constexpr std::size_t kTilts = 10;
constexpr double kTiltStep = 0.1;
constexpr std::size_t kLevels = 51;
constexpr double kLeastLevel = -1.0;
constexpr double kLevelStep = 0.05;

using Tilts = std::array<BandPower, kTilts>;

/// ln of the mean, over each band, of a shape's spectrum at level 1. That of the AR(1) process, (1 - c^2) / (1 + c^2 - 2 c cos w) or
/// 1 + 2 sum_k c^k cos kw, has the integral w + 2 sum_k c^k sin(kw) / k.
Tilts log_shapes() noexcept {
  const auto integral = [](std::size_t band) {
    constexpr int kTerms = 28;  // the next one is below 1e-18
    const double turns = 0.5 * static_cast<double>(band) / kNoiseBands;
    double sum = std::numbers::pi * turns;
    double power = 1.0;
    for (int k = 1; k <= kTerms; ++k) {
      power *= kColourPole;
      sum += power * portable_sine_cosine(k * turns).sine / k;
    }
    return 2.0 * sum;
  };
  Tilts shapes{};
  for (std::size_t band = 0; band < kNoiseBands; ++band) {
    const double coloured = (integral(band + 1) - integral(band)) * kNoiseBands / std::numbers::pi;
    for (std::size_t i = 0; i < kTilts; ++i)
      shapes[i][band] = portable_log(std::lerp(1.0, coloured, kTiltStep * static_cast<double>(i)));
  }
  return shapes;
}

/// ln(level) and tilt of point i of the grid.
double log_level_at(std::size_t i) noexcept {
  const std::size_t step = i % kLevels;
  return kLeastLevel + kLevelStep * static_cast<double>(step);
}
double tilt_at(std::size_t i) noexcept {
  const std::size_t step = i / kLevels;
  return kTiltStep * static_cast<double>(step);
}

/// ln of how likely what a band has is, where motion has this mean excess.
class BandLikelihood {
 public:
  explicit BandLikelihood(double mean_excess) noexcept
      : mean_excess_(mean_excess), moving_(kMotionBands / mean_excess) {}

  /// @param excess ln(power / noise's)
  [[nodiscard]] double log_at(double excess) const noexcept {
    const double deviations = excess / kBandDeviation;
    const double log_normal = -0.5 * deviations * deviations;
    if (excess <= 0.0) return std::max(at_zero_ + log_normal, kLeastLogLikelihood);
    if (deviations > 8.0) return log_moving_ - excess / mean_excess_;
    return portable_log(alone_ * portable_exp(log_normal) + moving_ * portable_exp(-excess / mean_excess_));
  }

 private:
  double mean_excess_;
  double alone_ = (1.0 - kMotionBands) / (kBandDeviation * std::sqrt(2.0 * std::numbers::pi));
  double moving_;
  double log_moving_ = portable_log(moving_);
  double at_zero_ = portable_log(alone_ + moving_);
};

/// ln of the weighted sum of what has these logarithms.
double log_mixture(double log_first, double log_second, double second_weight) noexcept {
  const double most = std::max(log_first, log_second);
  return most + portable_log((1.0 - second_weight) * portable_exp(log_first - most) +
                             second_weight * portable_exp(log_second - most));
}

const Tilts& all_log_shapes() noexcept {
  static const Tilts shapes = log_shapes();
  return shapes;
}

}  // namespace

NoiseShape likely_shape(const BandPower& power, bool known) noexcept {
  const Tilts& shapes = all_log_shapes();
  const double unit = known ? 1.0 : std::ranges::min(power);
  if (!(unit > 0.0)) return {.level = 0.0};
  BandPower log_power{};
  for (std::size_t band = 0; band < kNoiseBands; ++band)
    log_power[band] = portable_log(std::clamp(power[band] / unit, std::numeric_limits<double>::min(),
                                              std::numeric_limits<double>::max()));
  static const BandLikelihood likelihood{kMotionExcess};
  static const BandLikelihood shaking{kShakingExcess};
  std::array<double, kTilts * kLevels> posterior{};
  for (std::size_t i = 0; i < posterior.size(); ++i) {
    const BandPower& shape = shapes[i / kLevels];
    const double level = log_level_at(i);
    const double away = known ? level / kBelievedDeviation : 0.0;
    posterior[i] = -tilt_at(i) / kMeanTilt - 0.5 * away * away;
    double log_smooth = 0.0;
    double log_shaking = 0.0;
    for (std::size_t band = 0; band < kNoiseBands; ++band) {
      const double excess = log_power[band] - level - shape[band];
      log_smooth += likelihood.log_at(excess);
      if (known) log_shaking += shaking.log_at(excess);
    }
    posterior[i] += known ? log_mixture(log_smooth, log_shaking, kShaking) : log_smooth;
  }
  const double most = std::ranges::max(posterior);
  double sum = 0.0;
  double level = 0.0;
  double tilt = 0.0;
  for (std::size_t i = 0; i < posterior.size(); ++i) {
    const double weight = portable_exp(posterior[i] - most);
    sum += weight;
    level += weight * log_level_at(i);
    tilt += weight * tilt_at(i);
  }
  return {.level = unit * portable_exp(level / sum), .tilt = tilt / sum};
}

std::size_t bands_of_noise_alone(const BandPower& power, const NoiseShape& shape) noexcept {
  const BandPower& spectrum = all_log_shapes()[static_cast<std::size_t>(std::lround(shape.tilt / kTiltStep))];
  std::size_t count = 0;
  for (std::size_t band = 0; band < kNoiseBands; ++band)
    count +=
        std::abs(portable_log(power[band] / shape.level) - spectrum[band]) < 2.0 * kBandDeviation ? 1U : 0U;
  return count;
}

NoiseModel noise_of(const NoiseShape& shape) noexcept {
  NoiseModel noise = white_noise(shape.level * (1.0 - shape.tilt));
  if (shape.tilt <= 0.0) return noise;
  noise.colour_variance = shape.level * shape.tilt * (1.0 - kColourPole * kColourPole);
  noise.colour_order = 1;
  noise.colour[0] = kColourPole;
  return noise;
}

}  // namespace gyrod::core
