#include "core/evaluation/tuning.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

constexpr std::array<std::size_t, 1> kNow = {0};

// Random walk with steps of variance Q in white noise of variance R: the Kalman filter is an exponential average with the gain
//   K = (-q + sqrt(q^2 + 4 q)) / 2,   q = Q/R,   and its error has the variance K R   (Muth 1960).
TEST(Tuning, FindsTheKalmanGainOfARandomWalkInWhiteNoise) {
  constexpr std::size_t kSamples = 100'000;
  constexpr double kQ = 0.01;
  const auto truth = test::random_walk(kSamples, std::sqrt(kQ), 11);
  const auto noisy = test::sum_of(truth, test::white_noise(kSamples, 1.0, 12));
  const double gain = (-kQ + std::sqrt(kQ * kQ + 4.0 * kQ)) / 2.0;
  const auto best = tune(Rival::kExponential, {noisy, truth, {1000, kSamples}}, kNow);
  // 99 000 samples whose errors have a memory of 2/K = 20: 5000 independent ones, 1 % of the error; the optimum is flat, so that
  // the gain is known less well.
  EXPECT_NEAR(best[0].setting.parameter, gain, 0.05 * gain);
  EXPECT_NEAR(best[0].rmse, std::sqrt(gain), 0.02 * std::sqrt(gain));
}

// A fixed-lag smoother of the same: with a delay d the error falls, and never rises with the bound.
TEST(Tuning, NeverLosesByALargerBound) {
  const auto truth = test::random_walk(20'000, 0.1, 21);
  const auto noisy = test::sum_of(truth, test::white_noise(20'000, 1.0, 22));
  constexpr std::array<std::size_t, 4> kBounds = {0, 4, 8, 16};
  for (const Rival rival : kAllRivals) {
    const auto best = tune(rival, {noisy, truth, {500, 19'000}}, kBounds);
    for (std::size_t i = 0; i < kBounds.size(); ++i) {
      EXPECT_LE(best[i].setting.delay, kBounds[i]) << name_of(rival);
      EXPECT_EQ(best[i].lag_bound, kBounds[i]);
      if (i > 0) {
        EXPECT_LE(best[i].rmse, best[i - 1].rmse * (1.0 + 1e-4)) << name_of(rival);
      }
    }
  }
}

// Whoever tunes may leave the filter out. From noise alone to motion so quick that each filter is best left out.
TEST(Tuning, IsNeverWorseThanRaw) {
  constexpr std::array<std::size_t, 2> kBounds = {0, 5};
  for (const double step : {0.0, 0.1, 1.0, 30.0, 1e4}) {
    const auto truth = test::random_walk(2000, step, 23);
    std::vector<double> noisy = test::sum_of(truth, test::white_noise(2000, 1.0, 24));
    for (const std::size_t late : {0U, 5U}) {
      std::vector<double> delayed(late, noisy[0]);
      delayed.insert(delayed.end(), noisy.begin(), noisy.end() - static_cast<std::ptrdiff_t>(late));
      const TuningCase on{delayed, truth, {100, 1900}};
      const auto raw = tune(Rival::kRaw, on, kBounds);
      for (const Rival rival : kAllRivals) {
        const auto best = tune(rival, on, kBounds);
        for (std::size_t i = 0; i < kBounds.size(); ++i) {
          if (i > 0 && !is_causal(rival)) continue;  // answers of no delay
          EXPECT_LE(best[i].rmse, raw[i].rmse) << name_of(rival) << ", steps of " << step << ", " << late;
        }
      }
    }
  }
}

// Without its second parameter it is one; here the best of these has a cut-off beyond the sample rate, gain 0.92.
TEST(Tuning, OneEuroIsNeverWorseThanTheExponentialAverage) {
  for (const double step : {0.03, 1.0, 10.0}) {
    const auto truth = test::random_walk(5000, step, 25);
    const auto noisy = test::sum_of(truth, test::white_noise(5000, 0.3, 26));
    const TuningCase on{noisy, truth, {100, 4900}};
    EXPECT_LE(tune(Rival::kOneEuro, on, kNow)[0].rmse,
              (1.0 + 1e-4) * tune(Rival::kExponential, on, kNow)[0].rmse)
        << step;
  }
}

// A filter that hardly moves keeps what it began with. Where that happens to be the truth, it is no skill to find it.
TEST(Tuning, DoesNotTuneOneEuroToAStandstill) {
  const std::vector<double> truth(5000, 0.0);
  std::vector<double> noisy = test::white_noise(5000, 1.0, 29);
  noisy[0] = 0.0;
  const auto best = tune(Rival::kOneEuro, {noisy, truth, {100, 5000}}, kNow);
  EXPECT_GE(best[0].setting.parameter, TuningOptions{}.slowest * (1.0 - 1e-12));
}

// What the filter itself said is the truth: no error is left. Neither parameter lies on a grid.
TEST(Tuning, FindsBothParametersOfOneEuro) {
  const auto noisy = test::sum_of(test::random_walk(5000, 0.3, 27), test::white_noise(5000, 1.0, 28));
  for (const auto& [parameter, second] : {std::pair{0.0123, 0.0456}, std::pair{0.7, 40.0}}) {
    const auto truth = rival_output({Rival::kOneEuro, parameter, second, 0}, noisy);
    const auto best = tune(Rival::kOneEuro, {noisy, truth, {0, 5000}}, kNow);
    EXPECT_NEAR(best[0].setting.parameter, parameter, 0.1 * parameter);
    EXPECT_NEAR(best[0].setting.second, second, 0.1 * second);
  }
}

TEST(Tuning, FindsADelayThatIsThere) {
  const auto truth = test::random_walk(5000, 1.0, 31);
  std::vector<double> late(truth.size(), truth[0]);
  for (std::size_t t = 5; t < late.size(); ++t) late[t] = truth[t - 5];
  constexpr std::array<std::size_t, 2> kBounds = {3, 9};
  const auto best = tune(Rival::kRaw, {late, truth, {100, 4000}}, kBounds);
  EXPECT_EQ(best[0].setting.delay, 3U);
  EXPECT_EQ(best[1].setting.delay, 5U);
  EXPECT_DOUBLE_EQ(best[1].rmse, 0.0);
}

// White noise on a straight line: the longer the average the better, its middle is where the line is. Length 2 d + 1 = 33, 1/sqrt(33).
TEST(Tuning, FindsTheLengthOfAMovingAverageOnARamp) {
  std::vector<double> truth(40'000);
  for (std::size_t t = 0; t < truth.size(); ++t) truth[t] = static_cast<double>(t);
  const auto noisy = test::sum_of(truth, test::white_noise(truth.size(), 1.0, 41));
  constexpr std::array<std::size_t, 1> kBound = {16};
  const auto best = tune(Rival::kMovingAverage, {noisy, truth, {1000, 39'000}}, kBound);
  EXPECT_DOUBLE_EQ(best[0].setting.parameter, 33.0);
  EXPECT_EQ(best[0].setting.delay, 16U);
  EXPECT_NEAR(best[0].rmse, 1.0 / std::sqrt(33.0), 0.02 / std::sqrt(33.0));  // 38000 / 33 independent errors
}

TEST(Tuning, RemovesABiasWhole) {
  const auto truth = test::tone(1000, 0.01);
  auto noisy = truth;
  for (double& value : noisy) value += 0.7;
  const auto best = tune(Rival::kBiasRemoved, {noisy, truth, {0, 1000}}, kNow);
  EXPECT_NEAR(best[0].setting.parameter, 0.7, 1e-12);
  EXPECT_NEAR(best[0].rmse, 0.0, 1e-12);
}

TEST(Tuning, LeavesOutWhatTheTruthDoesNotKnow) {
  auto truth = test::random_walk(3000, 1.0, 51);
  const auto noisy = test::sum_of(truth, test::white_noise(3000, 1.0, 52));
  auto spoiled = noisy;
  for (std::size_t t = 1000; t < 1500; ++t) {
    truth[t] = std::numeric_limits<double>::quiet_NaN();
    spoiled[t] += 1000.0;
  }
  EXPECT_DOUBLE_EQ(tune(Rival::kRaw, {spoiled, truth, {0, 3000}}, kNow)[0].rmse,
                   tune(Rival::kRaw, {noisy, truth, {0, 3000}}, kNow)[0].rmse);
}

TEST(Tuning, HasNoErrorWhereNothingIsKnown) {
  const std::vector<double> noisy(100, 1.0);
  const std::vector<double> truth(100, std::numeric_limits<double>::quiet_NaN());
  for (const Rival rival : {Rival::kRaw, Rival::kButterworth2, Rival::kMovingAverage}) {
    EXPECT_TRUE(std::isnan(tune(rival, {noisy, truth, {0, 100}}, kNow)[0].rmse));
  }
}

TEST(Tuning, GivesAContenderThatRepeatsItsError) {
  const auto truth = test::random_walk(3000, 0.1, 61);
  const auto noisy = test::sum_of(truth, test::white_noise(3000, 1.0, 62));
  constexpr std::array<std::size_t, 1> kBound = {8};
  const auto best = tune(Rival::kButterworth2, {noisy, truth, {200, 2900}}, kBound);
  const Contender contender = method_of(best[0]).run(noisy);
  EXPECT_EQ(contender.name, "butterworth-2");
  EXPECT_EQ(contender.lag_samples, best[0].setting.delay);
  EXPECT_DOUBLE_EQ(delayed_rmse(contender.estimate, 0, truth, {200, 2900}), best[0].rmse);
}

}  // namespace
}  // namespace gyrod::core
