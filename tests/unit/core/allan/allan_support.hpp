/// What the tests of the Allan deviation share.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/allan/allan_deviation.hpp"
#include "core/allan/noise_coefficients.hpp"
#include "support/signals.hpp"

namespace gyrod::testing {

inline constexpr auto kQ = core::NoiseTerm::kQuantization;
inline constexpr auto kN = core::NoiseTerm::kAngleRandomWalk;
inline constexpr auto kB = core::NoiseTerm::kBiasInstability;
inline constexpr auto kK = core::NoiseTerm::kRateRandomWalk;
inline constexpr auto kR = core::NoiseTerm::kRateRamp;
inline constexpr std::array<core::NoiseTerm, core::kNoiseTerms> kAllTerms = {kQ, kN, kB, kK, kR};

/// Q, N, B, K, R of the sensor in evaluation tables, in this order.
using Five = std::array<double, core::kNoiseTerms>;

inline core::NoiseCoefficients coefficients_of(const Five& values) {
  core::NoiseCoefficients coefficients;
  for (std::size_t t = 0; t < values.size(); ++t) coefficients.terms[t] = {values[t], 0.0, values[t] != 0.0};
  return coefficients;
}

/// A curve that follows the model exactly, as from a record of this length.
inline std::vector<core::AllanPoint> exact_curve(const Five& values, double sample_rate_hz,
                                                 std::size_t samples) {
  std::vector<core::AllanPoint> points;
  for (const std::size_t m : core::cluster_sizes(samples, {})) {
    core::AllanPoint point;
    point.cluster_samples = m;
    point.tau_s = static_cast<double>(m) / sample_rate_hz;
    point.terms = samples - 2 * m + 1;
    point.deviation = core::model_deviation(coefficients_of(values), point.tau_s);
    point.edf = std::max(1.0, static_cast<double>(samples) / static_cast<double>(m));
    points.push_back(point);
  }
  return points;
}

/// Running sum of white noise with variance 1.
inline Signal random_walk(std::size_t size, unsigned seed) {
  Signal walk = white_noise(size, seed);
  for (std::size_t n = 1; n < size; ++n) walk[n] += walk[n - 1];
  return walk;
}

/// Differences of white noise with variance 1: what rounding an angle does to the rate.
inline Signal differenced_noise(std::size_t size, unsigned seed) {
  const Signal angle = white_noise(size + 1, seed);
  Signal rate(size);
  for (std::size_t n = 0; n < size; ++n) rate[n] = angle[n + 1] - angle[n];
  return rate;
}

}  // namespace gyrod::testing
