/// Signals and sums over them for the tests of the numerics.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <span>
#include <vector>

namespace gyrod::testing {

using Signal = std::vector<double>;

/// Normal, mean 0, variance 1.
inline Signal white_noise(std::size_t size, unsigned seed) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  Signal signal(size);
  std::ranges::generate(signal, [&] { return normal(bits); });
  return signal;
}

/// cos(2 pi frequency t + phase), frequency in cycles/sample.
inline Signal tone(std::size_t size, double frequency, double phase = 0.0) {
  Signal signal(size);
  for (std::size_t t = 0; t < size; ++t) {
    signal[t] = std::cos(2.0 * std::numbers::pi * frequency * static_cast<double>(t) + phase);
  }
  return signal;
}

/// x[k] = a_1 x[k-1] + ... + a_p x[k-p] + w[k], w normal with variance 1, after 1000 samples to settle.
inline Signal autoregressive(std::span<const double> a, std::size_t size, unsigned seed) {
  constexpr std::size_t kSettling = 1000;
  Signal signal = white_noise(kSettling + size, seed);
  for (std::size_t k = a.size(); k < signal.size(); ++k) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      signal[k] += a[i] * signal[k - 1 - i];
    }
  }
  return {signal.begin() + kSettling, signal.end()};
}

/// a + factor * b, element by element.
inline Signal sum(Signal a, const Signal& b, double factor = 1.0) {
  std::ranges::transform(a, b, a.begin(), [factor](double x, double y) { return x + factor * y; });
  return a;
}

inline Signal times(Signal signal, double factor) {
  std::ranges::transform(signal, signal.begin(), [factor](double x) { return factor * x; });
  return signal;
}

/// The signal in steps, as a converter of that resolution gives it.
inline Signal quantised(Signal signal, double resolution) {
  std::ranges::transform(signal, signal.begin(),
                         [resolution](double x) { return resolution * std::round(x / resolution); });
  return signal;
}

inline Signal reversed(Signal signal) {
  std::ranges::reverse(signal);
  return signal;
}

inline double peak(std::span<const double> signal) {
  double largest = 0.0;
  for (const double value : signal) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

inline double energy(std::span<const double> signal) {
  double squares = 0.0;
  for (const double value : signal) {
    squares += value * value;
  }
  return squares;
}

inline bool is_finite(std::span<const double> signal) {
  return std::ranges::all_of(signal, [](double value) { return std::isfinite(value); });
}

}  // namespace gyrod::testing
