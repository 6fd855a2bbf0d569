// The model, its units, and the polynomial fit.
#include "core/allan/noise_coefficients.hpp"

#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::in_degrees_and_hours;
using core::NoiseCoefficients;

// By IEEE Std 952-1997, annex C, for Q 1e-3, N 4e-2, B 9e-3, K 6e-4, R 1e-5: six digits.
TEST(NoiseModel, MeetsItsTable) {
  const NoiseCoefficients sensor = coefficients_of({1e-3, 4e-2, 9e-3, 6e-4, 1e-5});
  EXPECT_NEAR(model_deviation(sensor, 0.01), 0.435931, 5e-7);
  EXPECT_NEAR(model_deviation(sensor, 0.1), 0.127811, 5e-7);
  EXPECT_NEAR(model_deviation(sensor, 1.0), 0.0404829, 5e-8);
  EXPECT_NEAR(model_deviation(sensor, 10.0), 0.0140349, 5e-8);
  EXPECT_NEAR(model_deviation(sensor, 100.0), 0.00801519, 5e-9);
  EXPECT_NEAR(model_deviation(sensor, 1000.0), 0.0143994, 5e-8);
}

// Where the standard reads the lines: a term alone has the coefficient's value at its own time.
TEST(NoiseModel, EachTermAloneReadsItsCoefficientAtItsTime) {
  const auto alone = [](core::NoiseTerm term, double tau_s) {
    NoiseCoefficients coefficients;
    coefficients[term] = {2.0, 0.0, true};
    return model_deviation(coefficients, tau_s);
  };
  EXPECT_DOUBLE_EQ(alone(kQ, std::sqrt(3.0)), 2.0);
  EXPECT_DOUBLE_EQ(alone(kN, 1.0), 2.0);
  EXPECT_NEAR(alone(kB, 77.0), 0.664 * 2.0, 1e-3);  // the factor as it is usually printed
  EXPECT_DOUBLE_EQ(alone(kK, 3.0), 2.0);
  EXPECT_DOUBLE_EQ(alone(kR, std::sqrt(2.0)), 2.0);
  EXPECT_EQ(model_deviation(NoiseCoefficients{}, 1.0), 0.0);
}

// By hand: one degree is pi/180 rad, one hour 3600 s, its root 60.
TEST(NoiseUnits, OfDataSheetsFromSi) {
  const double degree = std::numbers::pi / 180.0;
  EXPECT_NEAR(in_degrees_and_hours(kQ, degree), 1.0, 1e-14);
  EXPECT_NEAR(in_degrees_and_hours(kN, degree / 60.0), 1.0, 1e-14);
  EXPECT_NEAR(in_degrees_and_hours(kB, degree / 3600.0), 1.0, 1e-14);
  EXPECT_NEAR(in_degrees_and_hours(kK, degree / 216'000.0), 1.0, 1e-14);
  EXPECT_NEAR(in_degrees_and_hours(kR, degree / 12'960'000.0), 1.0, 1e-14);
}

// White noise of standard deviation 1 a sample at 100 Hz, deviation 1 at 0.01 s: N = 0.1. A walk of step 1: K = 10.
TEST(NoiseUnits, PerSample) {
  EXPECT_DOUBLE_EQ(core::white_noise_per_sample(0.1, 100.0), 1.0);
  EXPECT_DOUBLE_EQ(core::random_walk_step_per_sample(10.0, 100.0), 1.0);
  // Two angles of standard deviation Q each, over one interval.
  EXPECT_DOUBLE_EQ(core::quantization_per_sample(0.01, 100.0), std::sqrt(2.0));
}

// The per-sample figures against the noise itself: 5 000 samples give a deviation to 1 to 2 %.
TEST(NoiseUnits, PerSampleFiguresMakeNoiseWithTheCoefficients) {
  constexpr double kRate = 50.0;
  const auto at = [](const Signal& rate) {
    return core::allan_deviation_at(rate, kRate, std::vector<std::size_t>{1}).at(0).deviation;
  };
  const double tau = 1.0 / kRate;
  const Signal white = times(white_noise(20'000, 1), core::white_noise_per_sample(0.3, kRate));
  EXPECT_NEAR(at(white), model_deviation(coefficients_of({0.0, 0.3, 0.0, 0.0, 0.0}), tau), 0.03 * at(white));
  const Signal quantized =
      times(differenced_noise(20'000, 2), core::quantization_per_sample(0.3, kRate) / std::sqrt(2.0));
  EXPECT_NEAR(at(quantized), model_deviation(coefficients_of({0.3, 0.0, 0.0, 0.0, 0.0}), tau),
              0.03 * at(quantized));
}

// A deviation that is a sum of powers of sqrt(tau) comes back: identity.
TEST(PolynomialFit, FindsThePolynomial) {
  const Five a = {2e-3, 3e-2, -4e-3, 5e-4, 6e-6};
  auto points = exact_curve({}, 100.0, 1'000'000);
  for (auto& point : points) {
    point.deviation = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
      point.deviation += a[n] * std::pow(point.tau_s, 0.5 * static_cast<double>(n) - 1.0);
    }
  }
  const NoiseCoefficients found = core::polynomial_coefficients(points);
  EXPECT_NEAR(found[kQ].value, a[0] / std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(found[kN].value, a[1], 1e-9);
  EXPECT_NEAR(found[kB].value, a[2] / std::sqrt(2.0 * std::numbers::ln2 / std::numbers::pi), 1e-9)
      << "negative as it comes";
  EXPECT_NEAR(found[kK].value, a[3] * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(found[kR].value, a[4] * std::sqrt(2.0), 1e-9);
}

TEST(PolynomialFit, NeedsSixPoints) {
  const auto points = exact_curve({0.0, 1.0, 0.0, 0.0, 0.0}, 1.0, 60);
  ASSERT_GE(points.size(), 6U);
  EXPECT_TRUE(core::polynomial_coefficients(std::span(points).first(6))[kN].observable);
  for (const auto& term : core::polynomial_coefficients(std::span(points).first(5)).terms) {
    EXPECT_FALSE(term.observable);
    EXPECT_EQ(term.value, 0.0);
  }
}

}  // namespace
}  // namespace gyrod
