// The filter against closed forms, and against what a matched filter must leave.
#include "core/denoise/ar_kalman.hpp"

#include <array>

#include <gtest/gtest.h>

#include "core/denoise/ar_model.hpp"
#include "core/signal/autocorrelation.hpp"
#include "core/signal/moments.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::ArKalman;
using namespace testing;

/// Ljung & Box 1978: Q = n (n+2) sum_{l=1..20} rho_l^2 / (n-l), chi-squared with 20 degrees of freedom for a
/// white series, which exceeds 45.3 once in a thousand.
bool is_white(const Signal& x) {
  constexpr std::size_t kLags = 20;
  constexpr double kQuantile = 45.3;
  std::array<double, kLags + 1> rho{};
  core::Autocorrelation(x.size()).acf(x, rho);
  const auto n = static_cast<double>(x.size());
  double q = 0.0;
  for (std::size_t lag = 1; lag <= kLags; ++lag) {
    q += n * (n + 2.0) * rho[lag] * rho[lag] / (n - static_cast<double>(lag));
  }
  return q < kQuantile;
}

TEST(Whiteness, IsFoundInWhiteNoiseAndNotInAr1) {
  EXPECT_TRUE(is_white(white_noise(5000, 1)));
  EXPECT_FALSE(is_white(autoregressive(std::array{0.2}, 5000, 1)));
}

// Residuals of the right order are white, those of one order less are not.
TEST(Whiteness, OfResidualsTellsTheOrder) {
  const Signal x = autoregressive(std::array{1.2, -0.5}, 5000, 2);
  for (const std::size_t order : {1U, 2U}) {
    const core::ArModel model = core::ArFitter(x.size(), order).fit(x);
    Signal residuals;
    for (std::size_t k = order; k < x.size(); ++k) {
      residuals.push_back(x[k] - model.a[0] * x[k - 1] - model.a[1] * x[k - 2 + (order == 1 ? 1 : 0)]);
    }
    EXPECT_EQ(is_white(residuals), order == 2);
  }
}

// Gain of AR(1): K = X / (X + r), X the positive root of X^2 - (q - r (1 - a^2)) X - q r = 0.
TEST(ArKalman, GainOfAr1IsTheClosedForm) {
  for (const double a : {0.1, 0.9, 0.999}) {
    for (const double q : {1e-10, 1e-6, 1e-3, 1.0}) {
      const double r = 1e-4;
      const double b = q - r * (1.0 - a * a);
      const double root = std::sqrt(b * b + 4.0 * q * r);
      const double x = b > 0.0 ? 0.5 * (b + root) : 2.0 * q * r / (root - b);
      ArKalman kalman;
      ASSERT_TRUE(kalman.design(std::array{a}, q, r));
      EXPECT_NEAR(kalman.gain()(0), x / (x + r), 1e-12) << a << " " << q;
      EXPECT_NEAR(kalman.innovation_variance(), x + r, 1e-12 * (x + r));
      EXPECT_NEAR(kalman.error_variance(), r * x / (x + r), 1e-12 * r);
    }
  }
}

struct Case {
  std::vector<double> a;
  double q;
  double r;
};

class MatchedFilter : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr std::size_t kSize = 20000;

  MatchedFilter()
      : truth_(times(autoregressive(GetParam().a, kSize, 3), std::sqrt(GetParam().q))),
        measured_(sum(truth_, white_noise(kSize, 4), std::sqrt(GetParam().r))) {}

  /// The innovations of a filter that was designed with q times `factor`: its correction is K_1 times the
  /// innovation, so what is left of the measurement is (1 - K_1) times it.
  Signal innovations(double factor) {
    EXPECT_TRUE(kalman_.design(GetParam().a, GetParam().q * factor, GetParam().r));
    filtered_ = measured_;
    kalman_.filter(filtered_);
    Signal left = times(sum(measured_, filtered_, -1.0), 1.0 / (1.0 - kalman_.gain()(0)));
    left.erase(left.begin(), left.begin() + 200);  // until the start is forgotten
    return left;
  }

  Signal truth_;
  Signal measured_;
  Signal filtered_;
  ArKalman kalman_;
};

INSTANTIATE_TEST_SUITE_P(Models, MatchedFilter,
                         ::testing::Values(Case{{0.95}, 1.0, 5.0}, Case{{1.6, -0.8}, 1.0, 10.0},
                                           Case{{1.6, -0.8}, 1e-6, 1e-5},
                                           Case{{2.76, -3.81, 2.65, -0.92}, 1.0, 100.0}));

TEST_P(MatchedFilter, HasWhiteInnovationsOfTheVarianceItStates) {
  const Signal left = innovations(1.0);
  EXPECT_TRUE(is_white(left));
  // Relative standard error of a variance: sqrt(2 / N).
  EXPECT_NEAR(core::variance(left) / kalman_.innovation_variance(), 1.0, 4.0 * std::sqrt(2.0 / kSize));
}

TEST_P(MatchedFilter, IsWrongByTheVarianceItStates) {
  innovations(1.0);
  // Errors are correlated over up to some 50 samples: 10 % is 3 to 4 standard errors.
  EXPECT_NEAR(core::mean_square(sum(filtered_, truth_, -1.0)) / kalman_.error_variance(), 1.0, 0.1);
}

TEST_P(MatchedFilter, WithTheWrongModelHasColouredInnovations) { EXPECT_FALSE(is_white(innovations(0.03))); }

TEST(ArKalman, KeepsTheFirstSamplesAsMeasuredAndPredictsFromThem) {
  ArKalman kalman;
  ASSERT_TRUE(kalman.design(std::array{0.5, 0.2, 0.1}, 1.0, 1.0));
  Signal z = white_noise(10, 5);
  const Signal measured = z;
  kalman.filter(z);
  EXPECT_TRUE(std::equal(z.begin(), z.begin() + 3, measured.begin()));
  const double prediction = 0.5 * measured[2] + 0.2 * measured[1] + 0.1 * measured[0];
  EXPECT_NEAR(z[3], prediction + kalman.gain()(0) * (measured[3] - prediction), 1e-15);
}

TEST(ArKalman, LeavesASeriesShorterThanItsOrderAlone) {
  ArKalman kalman;
  ASSERT_TRUE(kalman.design(std::array{0.5, 0.2, 0.1}, 1.0, 1.0));
  Signal z{1.0, 2.0};
  kalman.filter(z);
  EXPECT_EQ(z, (Signal{1.0, 2.0}));
  kalman.filter({});
}

// One part of noise in 1e12 of signal: the measurement is believed.
TEST(ArKalman, BelievesAMeasurementWithoutNoise) {
  ArKalman kalman;
  ASSERT_TRUE(kalman.design(std::array{1.6, -0.8}, 1.0, 1e-12));
  Signal z = white_noise(100, 6);
  const Signal measured = z;
  kalman.filter(z);
  EXPECT_LE(peak(sum(z, measured, -1.0)), 1e-10);
}

TEST(ArKalman, HasNoFilterWithoutBothNoises) {
  ArKalman kalman;
  const std::array a{0.5};
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(kalman.design(a, bad, 1.0)) << bad;
    EXPECT_FALSE(kalman.design(a, 1.0, bad)) << bad;
  }
}

TEST(ArKalman, StaysFiniteOnHostileSeries) {
  ArKalman kalman;
  ASSERT_TRUE(kalman.design(std::array{2.76, -3.81, 2.65, -0.92}, 1e-8, 1.0));
  Signal impulse(1000);
  impulse[10] = 1e300;
  for (Signal z : {impulse, Signal(1000, 1e300), Signal(1000, 1e-310), times(white_noise(1000, 7), 1e200)}) {
    kalman.filter(z);
    EXPECT_TRUE(is_finite(z));
  }
}

}  // namespace
}  // namespace gyrod
