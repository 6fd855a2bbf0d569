/// What the simulator's tests measure with.
#pragma once

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "core/simulation/gyro_errors.hpp"

namespace gyrod::core::test {

inline double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Covariance about the means, divided by n. @pre equal sizes
inline double covariance_of(std::span<const double> a, std::span<const double> b) {
  const double mean_a = mean_of(a);
  const double mean_b = mean_of(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size());
}

inline double standard_deviation_of(std::span<const double> values) {
  return std::sqrt(covariance_of(values, values));
}

/// Overlapping Allan deviation at cluster time m / sample_rate_hz, from the integrated rate theta:
///   sigma^2 = sum_k (theta[k+2m] - 2 theta[k+m] + theta[k])^2 / (2 tau^2 (n - 2m + 1)).
/// Source: IEEE Std 952-1997, annex C.
inline double allan_deviation(std::span<const double> rates, double sample_rate_hz, std::size_t m) {
  std::vector<double> theta(rates.size() + 1, 0.0);
  for (std::size_t i = 0; i < rates.size(); ++i) theta[i + 1] = theta[i] + rates[i] / sample_rate_hz;
  const double tau = static_cast<double>(m) / sample_rate_hz;
  double sum = 0.0;
  std::size_t terms = 0;
  for (std::size_t k = 0; k + 2 * m < theta.size(); ++k, ++terms) {
    const double difference = theta[k + 2 * m] - 2.0 * theta[k + m] + theta[k];
    sum += difference * difference;
  }
  return std::sqrt(sum / (2.0 * tau * tau * static_cast<double>(terms)));
}

/// What a sensor at rest measures.
inline std::vector<double> still_record(const GyroErrorOptions& options, double sample_rate_hz,
                                        std::size_t samples, std::uint64_t seed) {
  GyroErrors errors(options, sample_rate_hz, seed);
  std::vector<double> rates(samples);
  for (double& rate : rates) rate = errors.measure(0.0);
  return rates;
}

}  // namespace gyrod::core::test
