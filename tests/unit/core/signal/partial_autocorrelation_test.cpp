// The PACF against closed forms of Box & Jenkins, chapter 3.
#include <array>

#include <gtest/gtest.h>

#include "core/signal/autocorrelation.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr std::size_t kLags = 12;

/// rho_l = a_1 rho_(l-1) + a_2 rho_(l-2), rho_1 = a_1 / (1 - a_2): the Yule-Walker equations.
std::array<double, kLags + 1> acf_of_ar2(double a1, double a2) {
  std::array<double, kLags + 1> rho{1.0, a1 / (1.0 - a2)};
  for (std::size_t lag = 2; lag <= kLags; ++lag) {
    rho[lag] = a1 * rho[lag - 1] + a2 * rho[lag - 2];
  }
  return rho;
}

// 1e-14: the recursion divides by the prediction error, here 0.2 and more.
TEST(PartialAutocorrelation, OfAr2CutsOffAfterTwo) {
  std::array<double, kLags> pacf{};
  core::partial_autocorrelation(acf_of_ar2(1.2, -0.5), pacf);
  EXPECT_NEAR(pacf[0], 1.2 / 1.5, 1e-15);
  EXPECT_NEAR(pacf[1], -0.5, 1e-14);
  for (std::size_t lag = 3; lag <= kLags; ++lag) {
    EXPECT_NEAR(pacf[lag - 1], 0.0, 1e-14) << lag;
  }
}

// x[k] = w[k] + b w[k-1]: phi_ll = (-1)^(l+1) b^l (1 - b^2) / (1 - b^(2l+2)), which tails off.
TEST(PartialAutocorrelation, OfMa1TailsOffAsItsClosedForm) {
  constexpr double b = 0.7;
  std::array<double, kLags + 1> acf{1.0, b / (1.0 + b * b)};
  std::array<double, kLags> pacf{};
  core::partial_autocorrelation(acf, pacf);
  for (std::size_t lag = 1; lag <= kLags; ++lag) {
    const auto l = static_cast<double>(lag);
    const double sign = lag % 2 == 1 ? 1.0 : -1.0;
    EXPECT_NEAR(pacf[lag - 1], sign * std::pow(b, l) * (1.0 - b * b) / (1.0 - std::pow(b, 2.0 * l + 2.0)),
                1e-13)
        << lag;
  }
}

// Beyond the order estimates scatter with 1 / sqrt(N); phi_pp is a_p.
TEST(PartialAutocorrelation, OfASimulatedAr4CutsOffAfterFour) {
  constexpr std::size_t kSize = 100000;
  const std::array a{0.8, -0.4, 0.3, -0.35};
  const double four_deviations = 4.0 / std::sqrt(static_cast<double>(kSize));
  core::Autocorrelation autocorrelation(kSize);
  std::array<double, kLags + 1> acf{};
  std::array<double, kLags> pacf{};
  autocorrelation.acf(autoregressive(a, kSize, 1), acf);
  core::partial_autocorrelation(acf, pacf);
  EXPECT_NEAR(pacf[3], a[3], four_deviations);
  for (std::size_t lag = 5; lag <= kLags; ++lag) {
    EXPECT_NEAR(pacf[lag - 1], 0.0, four_deviations) << lag;
  }
}

TEST(PartialAutocorrelation, OfAPredictableSeriesEndsWithTheError) {
  const std::array acf{1.0, -1.0, 1.0, -1.0};
  std::array<double, 3> pacf{};
  core::partial_autocorrelation(acf, pacf);
  EXPECT_EQ(pacf, (std::array{-1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace gyrod
