/// Simulated ARMA processes for tests and studies of identification.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "support/signals.hpp"

namespace gyrod::testing {

/// x[k] = a_1 x[k-1] + ... + a_p x[k-p] + w[k] + b_1 w[k-1] + ... + b_q w[k-q].
struct ArmaProcess {
  std::vector<double> a;
  std::vector<double> b;

  [[nodiscard]] std::size_t p() const noexcept { return a.size(); }
  [[nodiscard]] std::size_t q() const noexcept { return b.size(); }
};

/// A realisation, w normal with variance 1, after 1000 samples to settle.
inline Signal realisation(const ArmaProcess& process, std::size_t size, unsigned seed) {
  constexpr std::size_t kSettling = 1000;
  const Signal w = white_noise(kSettling + size, seed);
  Signal x(w.size());
  for (std::size_t k = 0; k < w.size(); ++k) {
    x[k] = w[k];
    for (std::size_t i = 1; i <= process.p() && i <= k; ++i) x[k] += process.a[i - 1] * x[k - i];
    for (std::size_t i = 1; i <= process.q() && i <= k; ++i) x[k] += process.b[i - 1] * w[k - i];
  }
  return {x.begin() + kSettling, x.end()};
}

}  // namespace gyrod::testing
