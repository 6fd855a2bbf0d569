// The primary fit on curves that follow the model, and on such that cannot.
#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::fit_coefficients;
using core::NoiseCoefficients;

// The sensor of the model's table, on a record long enough to show all five: identity, limited by the linear solve.
TEST(CoefficientFit, RecoversAllFiveFromTheModelItself) {
  const Five truth = {1e-3, 4e-2, 9e-3, 6e-4, 1e-5};
  const NoiseCoefficients found = fit_coefficients(exact_curve(truth, 1000.0, 200'000'000));
  for (std::size_t t = 0; t < truth.size(); ++t) {
    EXPECT_TRUE(found.terms[t].observable) << t;
    EXPECT_NEAR(found.terms[t].value / truth[t], 1.0, 1e-6) << t;
    EXPECT_GT(found.terms[t].standard_error, 0.0);
    EXPECT_LT(found.terms[t].standard_error, 0.5 * truth[t]);
  }
}

// Each alone: the other four are not there, so no number may stand for them.
TEST(CoefficientFit, ATermAloneIsTheOnlyOneObservable) {
  for (std::size_t t = 0; t < core::kNoiseTerms; ++t) {
    Five truth{};
    truth[t] = 0.5;
    const NoiseCoefficients found = fit_coefficients(exact_curve(truth, 100.0, 1'000'000));
    for (std::size_t other = 0; other < core::kNoiseTerms; ++other) {
      EXPECT_EQ(found.terms[other].observable, other == t) << t << " " << other;
    }
    EXPECT_NEAR(found.terms[t].value, 0.5, 1e-6);
  }
}

TEST(CoefficientFit, ScalesWithTheCurve) {
  auto points = exact_curve({0.0, 4e-2, 9e-3, 6e-4, 0.0}, 100.0, 10'000'000);
  const NoiseCoefficients found = fit_coefficients(points);
  for (auto& point : points) point.deviation *= 1024.0;
  const NoiseCoefficients scaled = fit_coefficients(points);
  for (std::size_t t = 0; t < core::kNoiseTerms; ++t) {
    EXPECT_EQ(scaled.terms[t].observable, found.terms[t].observable);
    EXPECT_NEAR(scaled.terms[t].value, 1024.0 * found.terms[t].value, 1e-6 * scaled.terms[t].value);
  }
}

// A line in the spectrum is a hump of a few points. They must neither hide the white noise nor move it: half a per
// cent and an error of 2 %, where without less weight for far points it would be 2 % and 5 %.
TEST(CoefficientFit, AHumpNeitherHidesNorMovesTheWhiteNoise) {
  auto points = exact_curve({0.0, 0.04, 0.0, 0.0, 0.0}, 100.0, 1'000'000);
  points[1].deviation *= 2.0;
  points[2].deviation *= 1.7;
  points[3].deviation *= 1.4;
  const auto white = fit_coefficients(points)[kN];
  ASSERT_TRUE(white.observable);
  EXPECT_NEAR(white.value, 0.04, 0.005 * 0.04);
  EXPECT_LT(white.standard_error, 0.02 * white.value);
}

TEST(CoefficientFit, OfNothingIsNothing) {
  const auto none_observable = [](const std::vector<core::AllanPoint>& points) {
    for (const auto& term : fit_coefficients(points).terms) {
      EXPECT_FALSE(term.observable);
      EXPECT_EQ(term.value, 0.0);
      EXPECT_EQ(term.standard_error, 0.0);
    }
  };
  none_observable({});
  none_observable(core::allan_deviation(Signal(1000, 0.25), 100.0));  // constant
  none_observable(core::allan_deviation(white_noise(20, 1), 100.0));  // two points
}

// From the shortest record that gives three points on: finite, and never a negative coefficient.
TEST(CoefficientFit, OfAShortRecordIsFinite) {
  for (std::size_t samples = 30; samples < 400; samples += 7) {
    for (const auto& term : fit_coefficients(core::allan_deviation(white_noise(samples, 9), 100.0)).terms) {
      EXPECT_TRUE(std::isfinite(term.value) && std::isfinite(term.standard_error)) << samples;
      EXPECT_GE(term.value, 0.0);
      EXPECT_EQ(term.observable, term.value > 0.0);
    }
  }
}

}  // namespace
}  // namespace gyrod
