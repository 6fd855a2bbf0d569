// Ljung-Box against printed tables, its own formula, and its rates.
#include "core/denoise/whiteness.hpp"

#include <array>

#include <gtest/gtest.h>

#include "core/signal/autocorrelation.hpp"
#include "core/signal/chi_squared.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

// By hand: N = 100, rho_1 = 0.2 and no other: Q = 100 * 102 * 0.04 / 99.
TEST(LjungBox, IsItsFormula) {
  std::array<double, 24> acf{};
  acf[0] = 1.0;
  acf[1] = 0.2;
  const core::Whiteness result = core::test_whiteness(acf, 100, 3);
  EXPECT_EQ(result.lags, 23U);
  EXPECT_EQ(result.degrees_of_freedom, 20U);
  EXPECT_NEAR(result.ljung_box_q, 100.0 * 102.0 * 0.04 / 99.0, 1e-12);
  EXPECT_EQ(result.p_value, core::chi_squared_tail(result.ljung_box_q, 20.0));
  EXPECT_EQ(result.lags_outside, 1U) << "0.2 is above 1.96 / sqrt(100)";
  EXPECT_TRUE(result.within_bands);
}

TEST(LjungBox, NeedsMoreSamplesThanParameters) {
  const std::array<double, 40> acf{1.0};
  EXPECT_EQ(core::test_whiteness(acf, 12, 3).lags, 0U);
  EXPECT_FALSE(core::test_whiteness(acf, 12, 3).adequate) << "not tested is not passed";
  EXPECT_EQ(core::test_whiteness(acf, 40, 3).degrees_of_freedom, 7U);
}

// 400 trials at 5 %: 20 rejections expected, standard deviation 4.4.
TEST(LjungBox, RejectsWhiteNoiseInFiveOfAHundredCases) {
  core::Autocorrelation autocorrelation(2000);
  std::array<double, 21> acf{};
  unsigned rejected = 0;
  unsigned outside = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    autocorrelation.acf(white_noise(2000, seed), acf);
    const core::Whiteness result = core::test_whiteness(acf, 2000, 0);
    rejected += result.adequate ? 0U : 1U;
    outside += result.within_bands ? 0U : 1U;
  }
  EXPECT_NEAR(rejected, 20.0, 3.0 * 4.4);
  EXPECT_LE(outside, 8U + 9U)
      << "1.6 % by the binomial distribution of 20 lags at 5 %: 6, and three standard deviations";
}

TEST(LjungBox, RejectsAnAr1OfPointTwo) {
  core::Autocorrelation autocorrelation(5000);
  std::array<double, 21> acf{};
  autocorrelation.acf(autoregressive(std::array{0.2}, 5000, 1), acf);
  const core::Whiteness result = core::test_whiteness(acf, 5000, 0);
  EXPECT_LT(result.p_value, 1e-10);
  EXPECT_FALSE(result.adequate);
}

}  // namespace
}  // namespace gyrod
