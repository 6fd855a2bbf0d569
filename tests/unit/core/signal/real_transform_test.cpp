// The transform of real sequences, beside its definition.
#include "core/signal/real_transform.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

std::vector<double> sequence(std::size_t length) {
  std::vector<double> x(length);
  for (std::size_t n = 0; n < length; ++n) {
    const auto t = static_cast<double>(n);
    x[n] = std::sin(0.7 * t) + 0.01 * t + (n % 7 == 3 ? 1.0 : 0.0);
  }
  return x;
}

TEST(RealTransform, IsTheSumThatDefinesIt) {
  for (const std::size_t length : {4U, 8U, 12U, 64U, 100U, 512U}) {
    const std::vector<double> x = sequence(length);
    RealTransform transform(length);
    ASSERT_EQ(transform.bins(), length / 2 + 1);
    std::vector<std::complex<double>> spectrum(transform.bins());
    transform.forward(x, spectrum);
    for (std::size_t k = 0; k < spectrum.size(); ++k) {
      std::complex<double> sum;
      for (std::size_t n = 0; n < length; ++n) {
        const double turn = static_cast<double>(k * n % length) / static_cast<double>(length);
        sum += x[n] * std::polar(1.0, -2.0 * std::numbers::pi * turn);
      }
      EXPECT_NEAR(std::abs(spectrum[k] - sum), 0.0, 1e-12 * static_cast<double>(length))
          << length << ' ' << k;
    }
  }
}

TEST(RealTransform, ComesBack) {
  for (const std::size_t length : {4U, 8U, 64U, 1024U, 8192U}) {
    const std::vector<double> x = sequence(length);
    RealTransform transform(length);
    std::vector<std::complex<double>> spectrum(transform.bins());
    std::vector<double> back(length);
    transform.forward(x, spectrum);
    transform.inverse(spectrum, back);
    for (std::size_t n = 0; n < length; ++n) ASSERT_NEAR(back[n], x[n], 1e-12) << length << ' ' << n;
  }
}

}  // namespace
}  // namespace gyrod::core
