// Estimates against the process that made the series, and their errors against closed forms.
#include "core/denoise/arma_fitter.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/signal/moments.hpp"
#include "support/arma_process.hpp"

namespace gyrod {
namespace {

using core::ArmaFitter;
using core::ArmaModel;
using core::ArStatus;
using namespace testing;

constexpr std::size_t kSize = 5000;

ArmaModel fit(const Signal& x, std::size_t p, std::size_t q) {
  ArmaFitter fitter(x.size(), 8, 8);
  EXPECT_EQ(fitter.start(x), ArStatus::kFitted);
  return fitter.fit(p, q);
}

class ArmaEstimates : public ::testing::TestWithParam<ArmaProcess> {};

INSTANTIATE_TEST_SUITE_P(Processes, ArmaEstimates,
                         ::testing::Values(ArmaProcess{{0.7}, {}}, ArmaProcess{{1.2, -0.5}, {}},
                                           ArmaProcess{{2.2, -2.4, 1.4, -0.5}, {}}, ArmaProcess{{}, {0.6}},
                                           ArmaProcess{{}, {-0.9}}, ArmaProcess{{}, {0.8, 0.4}},
                                           ArmaProcess{{}, {0.7, 0.5, 0.4}}, ArmaProcess{{0.7}, {0.4}},
                                           ArmaProcess{{1.2, -0.5}, {0.5}},
                                           ArmaProcess{{1.2, -0.5}, {0.6, 0.3}}));

// An estimate lies beyond three of its standard errors in 0.3 % of cases. 20 series of up to four parameters: at most two in 80.
TEST_P(ArmaEstimates, AreWithinThreeStandardErrors) {
  const ArmaProcess& truth = GetParam();
  unsigned beyond = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ArmaModel model = fit(realisation(truth, kSize, seed), truth.p(), truth.q());
    ASSERT_EQ(model.status, ArStatus::kFitted);
    for (std::size_t i = 0; i < truth.p(); ++i)
      beyond += std::abs(model.a[i] - truth.a[i]) > 3.0 * model.a_error[i] ? 1U : 0U;
    for (std::size_t i = 0; i < truth.q(); ++i)
      beyond += std::abs(model.b[i] - truth.b[i]) > 3.0 * model.b_error[i] ? 1U : 0U;
    // Variance of the variance's estimate of N normal values: 2/N.
    EXPECT_NEAR(model.innovation_variance, 1.0, 4.0 * std::sqrt(2.0 / kSize));
  }
  EXPECT_LE(beyond, 2U);
}

// Box, Jenkins, section 7.2.6: var(a) = (1 - a^2) / N for AR(1), var(b) = (1 - b^2) / N for MA(1), and for ARMA(1,1) with this sign of b
//   var(a) = (1 - a^2) (1 + a b)^2 / (N (a + b)^2),   var(b) = (1 - b^2) (1 + a b)^2 / (N (a + b)^2).
// 5 %: the curvature is taken at the estimate, which is about two standard errors of 1 % off, and b's enters by 1 / (1 - b^2).
TEST(ArmaStandardErrors, AreTheClosedForms) {
  const double n = kSize;
  const ArmaModel ar = fit(realisation({{0.7}, {}}, kSize, 1), 1, 0);
  EXPECT_NEAR(ar.a_error[0], std::sqrt((1.0 - 0.49) / n), 0.05 * ar.a_error[0]);
  const ArmaModel ma = fit(realisation({{}, {0.6}}, kSize, 1), 0, 1);
  EXPECT_NEAR(ma.b_error[0], std::sqrt((1.0 - 0.36) / n), 0.05 * ma.b_error[0]);
  const ArmaModel arma = fit(realisation({{0.7}, {0.4}}, kSize, 1), 1, 1);
  const double common = 1.28 / 1.1 / std::sqrt(n);
  EXPECT_NEAR(arma.a_error[0], common * std::sqrt(1.0 - 0.49), 0.05 * arma.a_error[0]);
  EXPECT_NEAR(arma.b_error[0], common * std::sqrt(1.0 - 0.16), 0.05 * arma.b_error[0]);
}

// AR(1) by least squares over the fitter's rows: a = sum x[k] x[k-1] / sum x[k-1]^2.
TEST(ArmaFitter, OfAr1IsTheClosedFormOfLeastSquares) {
  const Signal x = realisation({{0.7}, {}}, 600, 3);
  ArmaFitter fitter(x.size(), 4, 4);
  ASSERT_EQ(fitter.start(x), ArStatus::kFitted);
  const double centre = core::mean(x);
  double above = 0.0;
  double below = 0.0;
  for (std::size_t k = fitter.first_row(); k < x.size(); ++k) {
    above += (x[k] - centre) * (x[k - 1] - centre);
    below += (x[k - 1] - centre) * (x[k - 1] - centre);
  }
  EXPECT_NEAR(fitter.fit(1, 0).a[0], above / below, 1e-12);
}

// The model that comes out leaves what the model's own recursion makes of the series.
TEST(ArmaFitter, ResidualsAreTheInnovationsOfTheModel) {
  const Signal x = realisation({{0.7}, {0.4}}, 1000, 4);
  ArmaFitter fitter(x.size(), 4, 4);
  ASSERT_EQ(fitter.start(x), ArStatus::kFitted);
  const ArmaModel model = fitter.fit(1, 1);
  const auto residuals = fitter.residuals(model);
  EXPECT_NEAR(core::mean_square(residuals), model.innovation_variance, 1e-12);
  const Signal centred = sum(x, Signal(x.size(), 1.0), -core::mean(x));
  Signal w(x.size());
  core::innovations(model, centred, w);
  // The fitter starts one sample later; 50 rows on, 0.4^50 of the difference is left.
  EXPECT_NEAR(residuals.back(), w.back(), 1e-12);
}

TEST(ArmaFitter, ScaleAndOffsetChangeNoCoefficient) {
  const Signal x = realisation({{1.2, -0.5}, {0.5}}, 2000, 5);
  const ArmaModel model = fit(x, 2, 1);
  const ArmaModel scaled = fit(sum(times(x, 1e-6), Signal(x.size(), 1.0), 1e-3), 2, 1);
  EXPECT_NEAR(scaled.a[0], model.a[0], 1e-6) << "the offset rounds the series at 1e-13 of it";
  EXPECT_NEAR(scaled.b[0], model.b[0], 1e-6);
}

TEST(ArmaFitter, SaysWhyThereIsNoModel) {
  ArmaFitter fitter(100, 4, 4);
  EXPECT_EQ(fitter.start(Signal(100, 2.5)), ArStatus::kConstant);
  EXPECT_EQ(fitter.start(white_noise(20, 1)), ArStatus::kTooShort);
  EXPECT_EQ(fitter.start({}), ArStatus::kTooShort);
}

// A pure tone is predicted to rounding by AR(2), whose roots lie on the circle; a random walk has one there.
TEST(ArmaFitter, StaysStationaryInvertibleAndFiniteOnTheCircle) {
  Signal walk = white_noise(3000, 6);
  for (std::size_t k = 1; k < walk.size(); ++k) walk[k] += walk[k - 1];
  Signal differences = white_noise(3001, 7);  // MA(1) with b = -1: on the circle itself
  for (std::size_t k = 0; k + 1 < differences.size(); ++k)
    differences[k] = differences[k + 1] - differences[k];
  differences.pop_back();
  for (const Signal& x : {tone(3000, 0.01), walk, differences, sum(tone(3000, 1e-4), walk, 1e-9)}) {
    ArmaFitter fitter(x.size(), 6, 6);
    ASSERT_EQ(fitter.start(x), ArStatus::kFitted);
    for (std::size_t p = 0; p <= 6; ++p) {
      for (std::size_t q = 0; q <= 6; q += 2) {
        const ArmaModel model = fitter.fit(p, q);
        if (model.status == ArStatus::kTooShort) continue;  // singular
        EXPECT_TRUE(core::roots_within(model.ar(), 1.0)) << p << " " << q;
        EXPECT_TRUE(core::invertible_within(model.ma(), 1.0)) << p << " " << q;
        EXPECT_TRUE(is_finite(model.a) && is_finite(model.b) && std::isfinite(model.innovation_variance));
      }
    }
  }
}

}  // namespace
}  // namespace gyrod
