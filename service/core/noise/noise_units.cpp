#include "core/noise/noise_units.hpp"

#include <cmath>
#include <numbers>

#include "core/noise/noise_fit.hpp"
#include "core/noise/same_noise.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Frequencies that a spectrum with eight poles is averaged over.
constexpr int kFrequencies = 1024;

}  // namespace

double noise_density(const NoiseModel& model, double sample_rate_hz) noexcept {
  return std::sqrt(2.0 * noise_variance(model) / sample_rate_hz);
}

double angle_random_walk(const NoiseModel& model, double sample_rate_hz) noexcept {
  return std::sqrt(noise_spectrum(model, 0.0) / sample_rate_hz);
}

NoiseModel from_noise_density(double density, double sample_rate_hz) noexcept {
  return white_noise(density * density * 0.5 * sample_rate_hz);
}

/// Wider low-passes are none, as far as samples tell.
constexpr double kWidest = 100.0;

NoiseModel behind_low_pass(const NoiseModel& white, double bandwidth_hz, double sample_rate_hz) noexcept {
  constexpr double kLeft = 3e-4;
  const double width = bandwidth_hz / sample_rate_hz;
  const auto passes = [width](double cycles) {
    const double square = (cycles / width) * (cycles / width);
    return 1.0 / (1.0 + square * square);
  };
  // What is faster than half the sample rate folds back; from ten times the bandwidth on it is less than a thousandth of all.
  const auto folds = static_cast<int>(std::ceil(10.0 * std::min(width, kWidest)));
  NoiseSpectrum power{};
  for (std::size_t k = 0; k < power.size(); ++k) {
    const double cycles = static_cast<double>(k) / static_cast<double>(kNoiseSegment);
    double passed = kLeft;
    for (int fold = -folds; fold <= folds; ++fold) passed += passes(cycles + fold);
    power[k] = white.white_variance * passed;
  }
  return fit_noise(power).value_or(white);
}

NoiseModel from_angle_random_walk(double random_walk, double sample_rate_hz) noexcept {
  return white_noise(random_walk * random_walk * sample_rate_hz);
}

double lag_one_correlation(const NoiseModel& model) noexcept {
  if (!is_usable(model) || (model.colour_order == 0 && model.line_count == 0)) return 0.0;
  double lagged = 0.0;
  for (const SpectralLine& line : model.lines())
    lagged += line.variance * portable_sine_cosine(line.cycles).cosine;
  const NoiseModel rest = without_lines(model);
  for (int k = 0; k < kFrequencies; ++k) {
    const double turns = 0.5 * (static_cast<double>(k) + 0.5) / kFrequencies;
    lagged += noise_spectrum(rest, 2.0 * std::numbers::pi * turns) * portable_sine_cosine(turns).cosine /
              kFrequencies;
  }
  return lagged / noise_variance(model);
}

NoiseModel at_rate(const NoiseModel& model, double from_hz, double to_hz) noexcept {
  if (is_same_rate(to_hz, from_hz)) return model;
  const double rest = noise_variance(without_lines(model));
  return white_noise(rest * to_hz / from_hz + noise_variance(model) - rest);
}

}  // namespace gyrod::core
