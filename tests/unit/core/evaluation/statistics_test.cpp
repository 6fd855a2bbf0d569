#include "core/evaluation/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// White noise: standard error sigma / sqrt(N). From 400 batches it is known to 1/sqrt(800) = 3.5 %; three of these.
TEST(Statistics, MeanOfWhiteNoiseHasTheErrorOfTheTextbook) {
  const auto x = test::white_noise(40'000, 2.0, 1);
  const auto mean = batch_mean(x, 100);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->standard_error, 2.0 / 200.0, 0.105 * 2.0 / 200.0);
  EXPECT_LT(std::abs(mean->value), 4.0 * mean->standard_error);
}

// An AR(1) process with pole a: sigma / sqrt(N) (1 + a)/(1 - a))^(1/2), here 4.36 times that of white noise.
TEST(Statistics, MeanOfNoiseWithMemoryIsKnownLessWell) {
  auto x = test::white_noise(200'000, 1.0, 2);
  for (std::size_t t = 1; t < x.size(); ++t) x[t] += 0.9 * x[t - 1];
  const double expected = 10.0 / std::sqrt(200'000.0);  // 1 / (1 - a) per sqrt(N)
  EXPECT_NEAR(batch_mean(x, 500)->standard_error, expected,
              0.15 * expected);  // 400 batches, as above, and 2 % of bias
}

TEST(Statistics, LeavesOutWhatIsNotKnown) {
  const std::vector<double> x = {1.0, kNaN, 3.0, kNaN, kNaN, kNaN, 5.0, 7.0};
  EXPECT_DOUBLE_EQ(batch_mean(x, 2)->value, 4.0);
  EXPECT_FALSE(batch_mean(std::vector<double>{1.0, kNaN, kNaN}, 2));
}

TEST(Statistics, SlopeFindsAGainAndAnOffset) {
  const auto x = test::random_walk(5000, 1.0, 3);
  std::vector<double> y(x.size());
  for (std::size_t t = 0; t < x.size(); ++t) y[t] = 0.97 * x[t] - 4.0;
  y[17] = kNaN;
  const auto slope = batch_slope(x, y, 100);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, 0.97, 1e-12);
  EXPECT_LT(slope->standard_error, 1e-12);
}

// White x and noise: standard error sigma / sqrt(sum (x - mean)^2).
TEST(Statistics, SlopeInWhiteNoiseHasTheErrorOfTheTextbook) {
  const auto x = test::white_noise(40'000, 3.0, 4);
  const auto y = test::sum_of(x, test::white_noise(40'000, 1.5, 5));
  const double expected = 1.5 / (3.0 * 200.0);
  const auto slope = batch_slope(x, y, 100);
  EXPECT_NEAR(slope->standard_error, expected, 0.105 * expected);  // 400 batches
  EXPECT_NEAR(slope->value, 1.0, 4.0 * expected);
}

// x varies in one of seven batches more than in all others, as a drive turns: the line goes through that one. The slope's error is that of the
// textbook, and the standard error is to be no less (twice as much in the mean of squares would do no harm).
TEST(Statistics, SlopeDoesNotTrustTheOneBatchThatHoldsTheMotion) {
  constexpr std::size_t kBatch = 10;
  constexpr int kSeries = 400;
  auto x = test::white_noise(7 * kBatch, 0.3, 7);
  for (std::size_t t = 3 * kBatch; t < 4 * kBatch; ++t) x[t] *= 10.0;
  double claimed = 0.0;
  double squares = 0.0;
  for (int n = 0; n < kSeries; ++n) {
    const auto y = test::sum_of(x, test::white_noise(x.size(), 1.0, static_cast<unsigned>(100 + n)));
    const auto slope = batch_slope(x, y, kBatch);
    ASSERT_TRUE(slope);
    claimed += slope->standard_error * slope->standard_error / kSeries;
    squares += (slope->value - 1.0) * (slope->value - 1.0) / kSeries;
  }
  EXPECT_GT(claimed, squares);
}

TEST(Statistics, NoSlopeOnAConstant) {
  EXPECT_FALSE(batch_slope(std::vector<double>(100, 2.0), test::white_noise(100, 1.0, 6), 10));
  std::vector<double> once(100, 2.0);
  once[17] = 3.0;  // without its batch nothing varies
  EXPECT_FALSE(batch_slope(once, test::white_noise(100, 1.0, 6), 10));
}

// At 10 Hz means follow one another by a sample: 0.9 of a sine of 0.05 Hz, and noise that has nothing slow, + and - by turns.
TEST(Statistics, SlowSlopeSeesWhatIsSlow) {
  const auto slow = test::tone(600, 0.005, 3.0);
  std::vector<double> y(slow.size());
  for (std::size_t t = 0; t < y.size(); ++t) y[t] = 0.9 * slow[t] + (t % 2 == 0 ? 5.0 : -5.0);
  const auto slope = slow_slope(slow, y, 10.0);
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->value, 0.9, 1e-12);
}

TEST(Statistics, NoSlowSlopeOfLessThanTwentySeconds) {
  const auto slow = test::tone(200, 0.005, 3.0);
  EXPECT_TRUE(slow_slope(slow, slow, 10.0));
  EXPECT_FALSE(slow_slope(std::span(slow).first(199), std::span(slow).first(199), 10.0));
  EXPECT_TRUE(slow_slope(slow, slow, 0.3));  // a mean is of one sample at least
}

TEST(Statistics, IsWithinALimitOnlyWhereThatIsKnown) {
  EXPECT_EQ(within({0.004, 0.001}, 0.005), true);
  EXPECT_EQ(within({-0.006, 0.0025}, 0.005), false);  // as measured, as two errors are the limit
  EXPECT_EQ(within({0.004, 0.003}, 0.005), std::nullopt);
  EXPECT_EQ(within({-0.010, 0.003}, 0.005), std::nullopt);
  EXPECT_EQ(within({-0.012, 0.003}, 0.005), false);
}

TEST(Statistics, SwingResponseFindsGainAndDelay) {
  std::vector<double> change(3000);
  for (std::size_t t = 0; t < change.size(); ++t) {
    change[t] = 0.2 + 0.9 * 5.0 * std::sin(2.0 * std::numbers::pi * 0.01 * (static_cast<double>(t) - 7.25));
  }
  change[100] = kNaN;
  const auto response = swing_response(change, {50, 2973}, 0.01, 5.0, 500);
  ASSERT_TRUE(response);
  EXPECT_NEAR(response->gain, 0.9, 1e-9);
  EXPECT_NEAR(response->delay_samples, 7.25, 1e-6);
  EXPECT_LT(response->standard_error, 1e-6);
}

// What an estimator misses of slow motion has a memory: here of ten samples, so that near frequency 0 it has 19 times the power of white noise of its variance. As
// if it were white the error would be claimed 4 times too small.
TEST(Statistics, TheErrorOfASwingsGainKnowsOfMemory) {
  double squares = 0.0;
  constexpr unsigned kRuns = 40;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    auto change = test::white_noise(12'000, 0.5, seed);
    for (std::size_t t = 1; t < change.size(); ++t) change[t] += 0.9 * change[t - 1];
    for (std::size_t t = 0; t < change.size(); ++t)
      change[t] += 5.0 * std::sin(2.0 * std::numbers::pi * 0.001 * static_cast<double>(t));
    const auto response = swing_response(change, {0, change.size()}, 0.001, 5.0, 1000);
    ASSERT_TRUE(response);
    const double error = (response->gain - 1.0) / response->standard_error;
    squares += error * error / kRuns;
  }
  // Of 40 runs with 11 degrees of freedom each the mean of the square has a standard error of 0.3.
  EXPECT_GT(squares, 0.4);
  EXPECT_LT(squares, 2.2);
}

TEST(Statistics, ASwingInOneBatchHasNoKnownError) {
  const auto response = swing_response(test::tone(400, 0.01), {0, 400}, 0.01, 1.0, 1000);
  ASSERT_TRUE(response);
  EXPECT_TRUE(std::isinf(response->standard_error));
}

TEST(Statistics, NoSwingResponseFromLessThanAPeriod) {
  EXPECT_FALSE(swing_response(std::vector<double>(99, 1.0), {0, 99}, 0.01, 5.0, 500));
}

TEST(Statistics, CorrelationPeaksWhereASeriesWasShifted) {
  const auto truth = test::random_walk(4000, 1.0, 7);
  std::vector<double> late(truth.size(), 0.0);
  for (std::size_t t = 3; t < late.size(); ++t) late[t] = 2.0 + 0.5 * truth[t - 3];
  EXPECT_NEAR(correlation_peak(truth, late, {100, 3900}, 20, 1000)->value, 3.0, 0.01);
  EXPECT_NEAR(correlation_peak(late, truth, {100, 3900}, 20, 1000)->value, -3.0, 0.01);
}

// A tone of period 200: the parabola through three samples of a cosine is off by less than 1e-4 of a sample.
TEST(Statistics, CorrelationPeakIsFoundBetweenSamples) {
  const auto truth = test::tone(4000, 0.005);
  std::vector<double> late(truth.size());
  for (std::size_t t = 0; t < late.size(); ++t) {
    late[t] = std::sin(2.0 * std::numbers::pi * 0.005 * (static_cast<double>(t) - 1.4));
  }
  EXPECT_NEAR(correlation_peak(truth, late, {200, 3800}, 20, 1000)->value, 1.4, 1e-3);
}

/// x with white noise on it through a low-pass of ten samples: its correlation with x has a broad peak, some samples late.
std::vector<double> blurred(const std::vector<double>& x, unsigned seed) {
  const auto noise = test::white_noise(x.size(), 1.0, seed);
  std::vector<double> y(x.size());
  double low = 0.0;
  for (std::size_t t = 0; t < x.size(); ++t) y[t] = low += 0.1 * (x[t] + noise[t] - low);
  return y;
}

// The standard error is what the peaks of records of the same kind spread by. 40 records, so that their spread is known to a ninth.
TEST(Statistics, StandardErrorOfTheCorrelationPeakIsItsSpread) {
  double sum = 0.0;
  double squares = 0.0;
  double claimed = 0.0;
  constexpr unsigned kRecords = 40;
  for (unsigned seed = 1; seed <= kRecords; ++seed) {
    const auto truth = blurred(test::white_noise(20'000, 1.0, 1000 + seed), 2000 + seed);
    const auto peak = correlation_peak(truth, blurred(truth, seed), {100, 19'900}, 40, 1000);
    ASSERT_TRUE(peak);
    sum += peak->value;
    squares += peak->value * peak->value;
    claimed += peak->standard_error * peak->standard_error;
  }
  const double mean = sum / kRecords;
  const double spread = std::sqrt((squares - sum * mean) / (kRecords - 1));
  EXPECT_GT(mean, 1.0) << "the low-pass is late";
  EXPECT_GT(spread, 0.02);
  EXPECT_NEAR(std::sqrt(claimed / kRecords) / spread, 1.0, 0.4);
}

TEST(Statistics, CorrelationPeakOfLessThanTwoBatchesIsOfUnknownError) {
  const auto truth = test::random_walk(900, 1.0, 7);
  const auto peak = correlation_peak(truth, truth, {0, 900}, 20, 1000);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->value, 0.0, 0.01);
  EXPECT_TRUE(std::isinf(peak->standard_error));
}

// A batch in which the truth was lost tells nothing of how well the rest is known: (B - 1) / B counts the others.
TEST(Statistics, BatchesThatAreLostDoNotCountForTheCorrelationPeak) {
  const auto truth = blurred(test::white_noise(5000, 1.0, 3), 4);
  const auto estimate = blurred(truth, 5);
  const auto known = correlation_peak(truth, estimate, {100, 4100}, 40, 1000);
  auto lost = truth;
  std::fill(lost.begin() + 4100, lost.end(), std::numeric_limits<double>::quiet_NaN());
  const auto partly = correlation_peak(lost, estimate, {100, 4900}, 40, 1000);
  ASSERT_TRUE(known && partly);
  EXPECT_DOUBLE_EQ(partly->standard_error, known->standard_error);
}

TEST(Statistics, NoPeakForAConstantOrBeyondTheLastShift) {
  const auto truth = test::tone(4000, 0.005);
  EXPECT_FALSE(correlation_peak(truth, std::vector<double>(4000, 1.0), {200, 3800}, 20, 1000));
  std::vector<double> late(truth.size(), 0.0);
  for (std::size_t t = 30; t < late.size(); ++t) late[t] = truth[t - 30];
  EXPECT_FALSE(correlation_peak(truth, late, {200, 3800}, 20, 1000));
}

}  // namespace
}  // namespace gyrod::core
