#include "core/evaluation/rivals.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

/// What the filter makes of an impulse at t = 50.
std::vector<double> impulse_response(const RivalSetting& setting, std::size_t samples = 100) {
  std::vector<double> x(samples, 0.0);
  x[50] = 1.0;
  return rival_output(setting, x);
}

TEST(Rivals, ExponentialAverageAnswersAStepByItsClosedForm) {
  std::vector<double> step(60, 1.0);
  step[0] = 0.0;
  const auto y = rival_output({Rival::kExponential, 0.1}, step);
  for (std::size_t t = 0; t < step.size(); ++t) {
    ASSERT_NEAR(y[t], 1.0 - std::pow(0.9, static_cast<double>(t)), 1e-14);
  }
}

TEST(Rivals, MovingAverageIsLateOnARampByHalfItsLength) {
  std::vector<double> ramp(500);
  for (std::size_t t = 0; t < ramp.size(); ++t) ramp[t] = static_cast<double>(t);
  const auto y = rival_output({Rival::kMovingAverage, 21.0}, ramp);
  for (std::size_t t = 21; t < ramp.size(); ++t) ASSERT_NEAR(y[t], ramp[t] - 10.0, 1e-10);
}

// Savitzky and Golay 1964, table I: parabola through five points, (-3 12 17 12 -3)/35.
TEST(Rivals, SavitzkyGolayHasThePublishedWeightsInTheMiddle) {
  const auto y = impulse_response({Rival::kSavitzkyGolay, 5.0, 0.0, 2});
  const std::vector<double> weights = {-3.0, 12.0, 17.0, 12.0, -3.0};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(35.0 * y[50 + k], weights[k], 1e-11);
}

// The same least squares read at the newest point: 31/35 for it, then 9, -3, -5, 3 (Gorry 1990, Anal. Chem. 62(6), table I).
TEST(Rivals, SavitzkyGolayHasThePublishedWeightsAtTheEnd) {
  const auto y = impulse_response({Rival::kSavitzkyGolay, 5.0, 0.0, 0});
  const std::vector<double> weights = {31.0, 9.0, -3.0, -5.0, 3.0};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(35.0 * y[50 + k], weights[k], 1e-11);
}

TEST(Rivals, SavitzkyGolayKeepsAParabolaWhereverItIsRead) {
  std::vector<double> parabola(300);
  for (std::size_t t = 0; t < parabola.size(); ++t) {
    const auto s = static_cast<double>(t);
    parabola[t] = 1.0 - 0.1 * s + 0.003 * s * s;
  }
  for (const std::size_t delay : {0U, 3U, 10U}) {
    const auto y = rival_estimate({Rival::kSavitzkyGolay, 30.0, 0.0, delay}, parabola);
    for (std::size_t t = 30; t + delay < parabola.size(); ++t) ASSERT_NEAR(y[t], parabola[t], 1e-8);
  }
}

TEST(Rivals, WindowSumsDoNotDriftOverALongRecord) {
  constexpr std::size_t kLength = 999;
  const auto x = test::sum_of(std::vector<double>(300'000, 100.0), test::white_noise(300'000, 1.0, 3));
  const auto y = rival_output({Rival::kMovingAverage, static_cast<double>(kLength)}, x);
  double sum = 0.0;
  for (std::size_t k = 0; k < kLength; ++k) sum += x[x.size() - 1 - k];
  EXPECT_NEAR(y.back(), sum / kLength, 1e-9);  // values of 100, 1000 additions: 1e-11
}

// Kalata's equation (14): index = beta / sqrt(1 - alpha); and the steady filter's alpha^2 = 2 beta - alpha beta - beta^2 / 4 turned round.
TEST(Rivals, AlphaBetaGainsFulfilKalatasRelations) {
  for (const double index : {1e-6, 1e-3, 0.1, 1.0, 50.0}) {
    const AlphaBeta gain = alpha_beta_of(index);
    EXPECT_NEAR(gain.beta / std::sqrt(1.0 - gain.alpha), index, 1e-6 * index + 1e-12) << index;
    EXPECT_NEAR(gain.beta, 2.0 * (2.0 - gain.alpha) - 4.0 * std::sqrt(1.0 - gain.alpha), 1e-12);
    EXPECT_TRUE(gain.alpha > 0.0 && gain.alpha < 1.0);
  }
}

TEST(Rivals, AlphaBetaFollowsARampWithoutLag) {
  std::vector<double> ramp(3000);
  for (std::size_t t = 0; t < ramp.size(); ++t) ramp[t] = 0.02 * static_cast<double>(t);
  EXPECT_NEAR(rival_output({Rival::kAlphaBeta, 0.01}, ramp).back(), ramp.back(), 1e-9);
}

TEST(Rivals, OneEuroWithoutSpeedIsAnExponentialAverage) {
  const auto x = test::random_walk(500, 1.0, 9);
  constexpr double kTurn = 2.0 * std::numbers::pi * 0.02;
  EXPECT_THAT(rival_output({Rival::kOneEuro, 0.02, 0.0}, x),
              testing::Pointwise(testing::DoubleNear(1e-12),
                                 rival_output({Rival::kExponential, kTurn / (1.0 + kTurn)}, x)));
}

TEST(Rivals, OneEuroIsQuickerWhereTheRateChanges) {
  std::vector<double> step(400, 0.0);
  for (std::size_t t = 200; t < step.size(); ++t) step[t] = 10.0;
  const auto slow = rival_output({Rival::kOneEuro, 0.005, 0.0}, step);
  const auto quick = rival_output({Rival::kOneEuro, 0.005, 0.05}, step);
  EXPECT_GT(quick[220], slow[220] + 1.0);
}

TEST(Rivals, NoneRingsAfterAnOffset) {
  const std::vector<double> offset(400, -3.25);
  for (const Rival rival : kAllRivals) {
    if (rival == Rival::kBiasRemoved) continue;
    const double parameter = parameter_of(rival) == RivalParameter::kSamples ? 31.0 : 0.05;
    EXPECT_THAT(rival_output({rival, parameter, 0.1, 4}, offset),
                testing::Each(testing::DoubleNear(-3.25, 1e-9)))
        << name_of(rival);
  }
}

TEST(Rivals, PassEverythingWithTheParameterForThat) {
  const auto x = test::random_walk(500, 1.0, 13);
  for (const Rival rival : kAllRivals) {
    EXPECT_EQ(rival_output({rival, pass_through_of(rival), 0.0, 0}, x), x) << name_of(rival);
  }
}

// It is the limit of what lies below.
TEST(Rivals, NearTheParameterThatPassesEverythingNearlyEverythingPasses) {
  const auto x = test::random_walk(500, 1.0, 13);
  for (const Rival rival : {Rival::kButterworth1, Rival::kButterworth4, Rival::kZeroPhase2}) {
    EXPECT_THAT(rival_output({rival, 0.49999}, x), testing::Pointwise(testing::DoubleNear(0.01), x))
        << name_of(rival);
  }
  EXPECT_THAT(rival_output({Rival::kOneEuro, 1e4}, x), testing::Pointwise(testing::DoubleNear(0.01), x));
  EXPECT_THAT(rival_output({Rival::kAlphaBeta, 1e6}, x), testing::Pointwise(testing::DoubleNear(0.01), x));
}

TEST(Rivals, AnEstimateStandsAtTheSampleThatItIsOf) {
  const std::vector<double> x = {1.0, 2.0, 3.0, 4.0};
  const auto estimate = rival_estimate({Rival::kRaw, 0.0, 0.0, 1}, x);
  EXPECT_DOUBLE_EQ(estimate[0], 2.0);
  EXPECT_DOUBLE_EQ(estimate[2], 4.0);
  EXPECT_TRUE(std::isnan(estimate[3]));
}

TEST(Rivals, TakeAnEmptyRecord) {
  for (const Rival rival : kAllRivals) EXPECT_TRUE(rival_estimate({rival, 0.1, 0.0, 3}, {}).empty());
}

}  // namespace
}  // namespace gyrod::core
