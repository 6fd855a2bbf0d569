/// White noise for the report's tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace gyrod::testing {

inline std::vector<double> white_noise(std::size_t samples, double sigma, std::uint32_t seed,
                                       double mean = 0.0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(mean, sigma);
  std::vector<double> x(samples);
  for (double& value : x) value = normal(generator);
  return x;
}

}  // namespace gyrod::testing
