/// Series that the tests of core/evaluation share.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/simulation/random.hpp"

namespace gyrod::core::test {

/// amplitude * sin(2 pi frequency t), frequency in cycles per sample.
inline std::vector<double> tone(std::size_t samples, double frequency, double amplitude = 1.0) {
  std::vector<double> x(samples);
  for (std::size_t t = 0; t < samples; ++t) {
    x[t] = amplitude * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(t));
  }
  return x;
}

inline std::vector<double> white_noise(std::size_t samples, double deviation, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> x(samples);
  for (double& value : x) value = deviation * random.normal();
  return x;
}

inline std::vector<double> random_walk(std::size_t samples, double step_deviation, std::uint64_t seed) {
  std::vector<double> x = white_noise(samples, step_deviation, seed);
  for (std::size_t t = 1; t < samples; ++t) x[t] += x[t - 1];
  return x;
}

inline std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t t = 0; t < a.size(); ++t) a[t] += b[t];
  return a;
}

/// Root mean square over [begin, end).
inline double rms(const std::vector<double>& x, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t t = begin; t < end; ++t) sum += x[t] * x[t];
  return std::sqrt(sum / static_cast<double>(end - begin));
}

}  // namespace gyrod::core::test
