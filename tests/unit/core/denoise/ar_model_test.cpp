// Least squares and the order against closed forms and against series of known models.
#include "core/denoise/ar_model.hpp"

#include <array>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::ArFitter;
using core::ArModel;
using core::ArStatus;
using namespace testing;

/// sum over k = order..N-1 of x[k-i] x[k-j].
double product_sum(const Signal& x, std::size_t order, std::size_t i, std::size_t j) {
  double total = 0.0;
  for (std::size_t k = order; k < x.size(); ++k) {
    total += x[k - i] * x[k - j];
  }
  return total;
}

// Normal equation of one unknown: a = sum x[k] x[k-1] / sum x[k-1]^2.
TEST(ArFitter, OfOrderOneIsTheClosedForm) {
  const Signal x = autoregressive(std::array{0.8}, 500, 1);
  const double a = product_sum(x, 1, 0, 1) / product_sum(x, 1, 1, 1);
  const ArModel model = ArFitter(500, 1).fit(x);
  ASSERT_EQ(model.order, 1U);
  EXPECT_EQ(model.status, ArStatus::kFitted);
  EXPECT_NEAR(model.a[0], a, 1e-13);
  EXPECT_NEAR(model.innovation_variance, (product_sum(x, 1, 0, 0) - a * product_sum(x, 1, 0, 1)) / 499.0,
              1e-13);
}

// Normal equations of two unknowns by Cramer's rule.
TEST(ArFitter, OfOrderTwoIsTheClosedForm) {
  const Signal x = autoregressive(std::array{1.2, -0.5}, 500, 2);
  const double s11 = product_sum(x, 2, 1, 1);
  const double s12 = product_sum(x, 2, 1, 2);
  const double s22 = product_sum(x, 2, 2, 2);
  const double r1 = product_sum(x, 2, 0, 1);
  const double r2 = product_sum(x, 2, 0, 2);
  const double determinant = s11 * s22 - s12 * s12;
  const ArModel model = ArFitter(500, 2).fit(x);
  ASSERT_EQ(model.order, 2U);
  EXPECT_NEAR(model.a[0], (r1 * s22 - r2 * s12) / determinant, 1e-12);
  EXPECT_NEAR(model.a[1], (r2 * s11 - r1 * s12) / determinant, 1e-12);
}

/// What the fit must find again: BIC takes a superfluous coefficient with a probability of 0.2 % at N = 20
/// 000.
class ArOrder : public ::testing::TestWithParam<std::vector<double>> {};

INSTANTIATE_TEST_SUITE_P(Known, ArOrder,
                         ::testing::Values(std::vector{0.9}, std::vector{1.6, -0.8},
                                           std::vector{0.8, -0.4, 0.3, -0.35},
                                           std::vector{2.76, -3.81, 2.65, -0.92}));

TEST_P(ArOrder, IsFoundByBicAndCoefficientsAndInnovationsToo) {
  constexpr std::size_t kSize = 20000;
  ArFitter fitter(kSize, 8);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const ArModel model = fitter.fit(autoregressive(GetParam(), kSize, seed));
    ASSERT_EQ(model.order, GetParam().size()) << seed;
    EXPECT_EQ(model.status, ArStatus::kFitted);
    for (std::size_t i = 0; i < model.order; ++i) {
      EXPECT_NEAR(model.a[i], GetParam()[i], 4.0 / std::sqrt(kSize)) << "at most 1 / sqrt(N) each";
    }
    EXPECT_NEAR(model.innovation_variance, 1.0, 4.0 * std::sqrt(2.0 / kSize));
    EXPECT_EQ(model.a[model.order], 0.0) << "zero beyond the order";
  }
}

TEST(ArFitter, FindsLittleToPredictInWhiteNoise) {
  const ArModel model = ArFitter(20000, 8).fit(white_noise(20000, 3));
  EXPECT_EQ(model.order, 1U) << "there is no order 0";
  EXPECT_NEAR(model.a[0], 0.0, 4.0 / std::sqrt(20000.0));
}

// A tone is x[k] = 2 cos(w) x[k-1] - x[k-2] without innovations. Its normal equations are singular to
// rounding at order 6; the factorisation of the series itself is not troubled. The roots on the circle are
// pulled in to 0.9999.
TEST(ArFitter, PredictsAPureTone) {
  const Signal x = tone(1024, 0.01);
  const ArModel model = ArFitter(1024, 6).fit(x);
  ASSERT_GE(model.order, 2U);
  EXPECT_LE(model.innovation_variance, 1e-20);
  EXPECT_TRUE(core::roots_within(model.coefficients(), ArModel::kMaxRootRadius));
  for (std::size_t k = model.order; k < x.size(); ++k) {
    double prediction = 0.0;
    for (std::size_t i = 0; i < model.order; ++i) {
      prediction += model.a[i] * x[k - 1 - i];
    }
    ASSERT_NEAR(prediction, x[k], 1e-3) << k;
  }
}

TEST(ArFitter, OfAScaledSeriesHasTheSameCoefficients) {
  const Signal x = autoregressive(std::array{1.2, -0.5}, 300, 4);
  ArFitter fitter(300, 6);
  const ArModel model = fitter.fit(x);
  const ArModel scaled = fitter.fit(times(x, 0x1p-30));
  EXPECT_EQ(scaled.a, model.a);
  EXPECT_EQ(scaled.innovation_variance, model.innovation_variance * 0x1p-60);
}

TEST(ArFitter, OfAConstantHasNoModel) {
  for (const double level : {0.0, 0.1, -3.0, 1e300}) {
    const ArModel model = ArFitter(100, 6).fit(Signal(100, level));
    EXPECT_EQ(model.status, ArStatus::kConstant) << level;
    EXPECT_EQ(model.order, 0U);
    EXPECT_EQ(model.innovation_variance, 0.0);
  }
}

TEST(ArFitter, OfTooShortASeriesHasNoModel) {
  ArFitter fitter(ArFitter::kMinSamples, 6);
  for (std::size_t size = 0; size < ArFitter::kMinSamples; ++size) {
    const ArModel model = fitter.fit(white_noise(size, 5));
    EXPECT_EQ(model.status, ArStatus::kTooShort) << size;
    EXPECT_EQ(model.order, 0U);
  }
  EXPECT_NE(fitter.fit(white_noise(ArFitter::kMinSamples, 5)).status, ArStatus::kTooShort);
}

TEST(ArFitter, GivesAShortSeriesAQuarterOfItsLengthAtMost) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    EXPECT_LE(ArFitter(100, 16).fit(white_noise(11, seed)).order, 2U);
  }
}

TEST(ArFitter, RefusesAnOrderLimitOutsideItsRange) {
  EXPECT_THROW(ArFitter(100, 0), std::invalid_argument);
  EXPECT_THROW(ArFitter(100, core::kMaxArOrder + 1), std::invalid_argument);
  EXPECT_NO_THROW(ArFitter(100, core::kMaxArOrder));
}

}  // namespace
}  // namespace gyrod
