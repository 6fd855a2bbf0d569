#include "core/evaluation/error_figures.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Contender contender_of(std::vector<double> estimate) {
  Contender contender;
  contender.name = "test";
  contender.estimate = std::move(estimate);
  return contender;
}

TEST(ErrorFigures, OfAConstantOffsetAreItsClosedForm) {
  const auto truth = test::random_walk(12'000, 0.1, 1);
  auto estimate = truth;
  for (double& value : estimate) value += 0.05;
  const auto figures = error_figures(truth, contender_of(estimate), {.rate_hz = 100.0, .range = {0, 12'000}});
  EXPECT_EQ(figures.samples, 12'000U);
  EXPECT_NEAR(figures.rmse, 0.05, 1e-12);
  EXPECT_NEAR(figures.rmse_without_bias, 0.0, 1e-12);
  EXPECT_NEAR(figures.bias->value, 0.05, 1e-12);
  EXPECT_NEAR(figures.scale_factor->value, 1.0, 1e-12);
  EXPECT_EQ(figures.angle_10s->windows, 12U);
  EXPECT_NEAR(figures.angle_10s->rms, 0.5, 1e-9);  // 0.05 deg/s for 10 s
  EXPECT_NEAR(figures.angle_10s->std, 0.0, 1e-6);  // a square root of rounding
  EXPECT_EQ(figures.angle_60s->windows, 2U);
  EXPECT_NEAR(figures.angle_60s->mean, 3.0, 1e-9);
  EXPECT_NEAR(figures.angle_60s->max_abs, 3.0, 1e-9);
  EXPECT_FALSE(figures.normalised_error);
}

// White noise of sigma adds up to sigma sqrt(10 s fs) / fs. 1000 windows: 2.2 %; three of these.
TEST(ErrorFigures, AngleOfWhiteNoiseGrowsAsItsSquareRoot) {
  const auto angle = angle_error(test::white_noise(1'000'000, 0.3, 2), 100.0, 10.0);
  EXPECT_NEAR(angle->rms, 0.3 * std::sqrt(1000.0) / 100.0, 0.07 * 0.3 * std::sqrt(1000.0) / 100.0);
}

TEST(ErrorFigures, CountsAndLeavesOutWhatIsLost) {
  auto truth = test::random_walk(5000, 0.1, 3);
  auto estimate = truth;
  for (std::size_t t = 0; t < 5000; ++t) estimate[t] += t < 1100 ? 100.0 : 1.0;
  for (std::size_t t = 1000; t < 1100; ++t) truth[t] = kNaN;
  for (std::size_t t = 4990; t < 5000; ++t) estimate[t] = kNaN;
  const auto figures =
      error_figures(truth, contender_of(estimate), {.rate_hz = 100.0, .range = {1000, 5000}});
  EXPECT_EQ(figures.lost_truth, 100U);
  EXPECT_EQ(figures.lost_estimate, 10U);
  EXPECT_EQ(figures.samples, 3890U);
  EXPECT_NEAR(figures.rmse, 1.0, 1e-12);
  EXPECT_EQ(figures.angle_10s->windows, 2U);  // the first and the last of four have something lost
}

TEST(ErrorFigures, AClaimTwiceTooBoldHasANormalisedErrorOfTwo) {
  const std::vector<double> truth(50'000, 0.0);
  Contender contender = contender_of(test::white_noise(50'000, 0.2, 4));
  contender.std.emplace(50'000, 0.1);
  const auto figures = error_figures(truth, contender, {.rate_hz = 100.0, .range = {0, 50'000}});
  EXPECT_NEAR(*figures.normalised_error, 2.0, 0.03);  // 1/sqrt(2 N) = 0.3 %
}

// A bias that the truth does not know: sqrt(0.2^2 + 0.3^2), and without it 0.2, of which 0.1 are claimed. What is lost plays no part.
TEST(ErrorFigures, WithoutBiasAreThoseOfTheNoise) {
  std::vector<double> truth(50'000, 0.0);
  Contender contender = contender_of(test::white_noise(50'000, 0.2, 4));
  for (double& value : contender.estimate) value += 0.3;
  contender.std.emplace(50'000, 0.1);
  for (std::size_t t = 100; t < 20'000; ++t) {
    truth[t] = kNaN;
    contender.estimate[t] = 1000.0;
  }
  const auto figures = error_figures(truth, contender, {.rate_hz = 100.0, .range = {0, 50'000}});
  EXPECT_NEAR(figures.rmse, std::hypot(0.2, 0.3), 0.003);
  EXPECT_NEAR(figures.rmse_without_bias, 0.2, 0.003);
  EXPECT_NEAR(*figures.normalised_error, std::hypot(2.0, 3.0), 0.03);
  EXPECT_NEAR(*figures.normalised_error_without_bias, 2.0, 0.03);
}

TEST(ErrorFigures, SeesWhatShrinksAndWhatIsLate) {
  const auto truth = test::random_walk(9000, 0.1, 5);
  std::vector<double> estimate(truth.size(), 0.0);
  for (std::size_t t = 4; t < truth.size(); ++t) estimate[t] = 0.9 * truth[t - 4];
  const auto figures = error_figures(truth, contender_of(estimate), {.rate_hz = 100.0, .range = {100, 8900}});
  EXPECT_NEAR(figures.peak_lag_samples->value, 4.0, 0.05);
  EXPECT_NEAR(figures.scale_factor->value, 0.9, 0.02);
}

TEST(ErrorFigures, OfNothingAreNothing) {
  const auto figures = error_figures(std::vector<double>(50, kNaN),
                                     contender_of(std::vector<double>(50, 1.0)), {.range = {0, 50}});
  EXPECT_EQ(figures.samples, 0U);
  EXPECT_TRUE(std::isnan(figures.rmse));
  EXPECT_FALSE(figures.bias || figures.angle_10s || figures.scale_factor || figures.peak_lag_samples);
}

}  // namespace
}  // namespace gyrod::core
