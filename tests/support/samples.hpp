/// Makers of samples for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::testing {

inline constexpr std::int64_t kPeriodNs = 10'000'000;  // 100 Hz

/// Sample number `sequence` of a 100 Hz sensor.
[[nodiscard]] inline stream::Sample sample_at(std::uint64_t sequence, double x = 0.0) {
  return {sequence, static_cast<std::int64_t>(sequence) * kPeriodNs, {x, -x, 0.5 * x}};
}

/// `count` samples from `first` on that count up: x = sequence.
[[nodiscard]] inline std::vector<stream::Sample> counting_samples(std::uint64_t count,
                                                                  std::uint64_t first = 0) {
  std::vector<stream::Sample> samples;
  for (std::uint64_t n = first; n < first + count; ++n)
    samples.push_back(sample_at(n, static_cast<double>(n)));
  return samples;
}

/// The same samples of a sensor with another rate, Hz.
[[nodiscard]] inline std::vector<stream::Sample> at_rate(std::vector<stream::Sample> samples,
                                                         std::int64_t rate_hz) {
  for (stream::Sample& sample : samples)
    sample.stamp_ns = static_cast<std::int64_t>(sample.sequence) * (1'000'000'000 / rate_hz);
  return samples;
}

/// A slow swing with pseudo-random noise from a fixed linear congruential generator.
[[nodiscard]] inline std::vector<stream::Sample> noisy_samples(std::uint64_t count, std::uint64_t seed = 1) {
  std::vector<stream::Sample> samples;
  std::uint64_t state = seed;
  const auto noise = [&state] {
    double sum = -6.0;  // twelve uniforms: close enough to normal
    for (int i = 0; i < 12; ++i) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      sum += static_cast<double>(state >> 11U) / 9007199254740992.0;
    }
    return 0.006 * sum;
  };
  for (std::uint64_t n = 0; n < count; ++n) {
    stream::Sample sample = sample_at(n, 0.1 * std::sin(0.01 * static_cast<double>(n)));
    for (double& rate : sample.rate_radps) rate += noise();
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace gyrod::testing
