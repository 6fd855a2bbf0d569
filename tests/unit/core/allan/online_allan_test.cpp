#include "core/allan/online_allan.hpp"

#include <cmath>
#include <limits>
#include <span>

#include <gtest/gtest.h>

#include "allan_support.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::white_noise;

/// A sample becomes a multiple of the quantum: rates that are such multiples are not rounded, and equality can be demanded.
testing::Signal gridded(testing::Signal rate, double scale) {
  constexpr double kGrid = 1024.0 * OnlineAllan::kQuantum;
  for (double& value : rate) value = std::round(scale * value / kGrid) * kGrid;
  return rate;
}

AllanSums online(std::span<const double> rate) {
  OnlineAllan estimator;
  for (const double value : rate) estimator.step(value);
  return estimator.sums();
}

/// The definition in the header, term by term from sums of long double.
AllanSums by_definition(std::span<const double> rate) {
  std::vector<long double> x(rate.size() + 1, 0.0L);
  for (std::size_t n = 0; n < rate.size(); ++n) x[n + 1] = x[n] + static_cast<long double>(rate[n]);
  AllanSums sums;
  for (std::size_t j = 0; j < kAllanOctaves; ++j) {
    const std::size_t m = allan_cluster(j);
    long double squares = 0.0L;
    for (std::size_t k = 0; k + 2 * m <= rate.size(); k += allan_stride(j)) {
      const long double z = x[k + 2 * m] - 2.0L * x[k + m] + x[k];
      squares += z * z;
      ++sums.terms[j];
    }
    sums.squares[j] = static_cast<double>(squares);
  }
  return sums;
}

void expect_equal(const AllanSums& sums, const AllanSums& expected) {
  EXPECT_EQ(sums.terms, expected.terms);
  // Both round at the last place of a double.
  for (std::size_t j = 0; j < kAllanOctaves; ++j)
    EXPECT_NEAR(sums.squares[j], expected.squares[j], 1e-15 * expected.squares[j]) << "octave " << j;
}

TEST(OnlineAllan, IsItsDefinitionTermByTerm) {
  for (const std::size_t samples : {0U, 1U, 2U, 3U, 17U, 100U, 4096U, 50'001U}) {
    SCOPED_TRACE(samples);
    const auto rate = gridded(testing::random_walk(samples, 3), 1e-3);
    expect_equal(online(rate), by_definition(rate));
  }
}

// Clusters of up to eight samples move on by one sample: the very terms of the offline estimator.
TEST(OnlineAllan, EqualsTheOfflineDeviationWhereItMovesBySamples) {
  const auto rate = white_noise(20'000, 5);
  const AllanSums sums = online(rate);
  const std::vector<std::size_t> sizes = {1, 2, 4, 8};
  const auto offline = allan_deviation_at(rate, 100.0, sizes);
  const auto points = allan_points(sums, 100.0);
  for (std::size_t j = 0; j < sizes.size(); ++j) {
    EXPECT_EQ(points[j].terms, offline[j].terms);
    EXPECT_EQ(points[j].tau_s, offline[j].tau_s);
    // Samples of about 1 are rounded by 3e-11.
    EXPECT_NEAR(points[j].deviation, offline[j].deviation, 1e-10);
    EXPECT_NEAR(points[j].edf, offline[j].edf, 1e-9 * offline[j].edf) << "white is found to be white";
  }
}

// Every eighth of a cluster is nearly all there is to know: the difference from all terms is far below the estimate's own error.
TEST(OnlineAllan, IsAsGoodAsTheOfflineDeviationWhereItMovesByEighths) {
  const auto rate = white_noise(200'000, 6);
  const auto points = allan_points(online(rate), 100.0);
  std::vector<std::size_t> sizes;
  for (const AllanPoint& point : points) sizes.push_back(point.cluster_samples);
  const auto offline = allan_deviation_at(rate, 100.0, sizes);
  ASSERT_GE(points.size(), 16U);
  for (std::size_t j = 0; j + 2 < points.size(); ++j) {
    const double error = offline[j].deviation / std::sqrt(2.0 * offline[j].edf);
    EXPECT_NEAR(points[j].deviation, offline[j].deviation, 0.3 * error) << sizes[j];
    EXPECT_NEAR(points[j].edf, offline[j].edf, 0.1 * offline[j].edf) << sizes[j];
  }
}

TEST(OnlineAllan, GivesTheCoefficientsOfWhiteNoise) {
  const double n = 7e-4;  // rad/s/sqrt(Hz)
  auto rate = white_noise(360'000, 7);
  for (double& value : rate) value *= n * std::sqrt(100.0);
  const NoiseCoefficients fit = fit_coefficients(allan_points(online(rate), 100.0));
  ASSERT_TRUE(fit[testing::kN].observable);
  // An hour tells N to 0.6 % (docs/allan.md); three of these.
  EXPECT_NEAR(fit[testing::kN].value, n, 0.02 * n);
  EXPECT_FALSE(fit[testing::kB].observable);
}

TEST(OnlineAllan, AddsUpStretchesAndGivesUpClustersAtAGap) {
  const auto rate = gridded(white_noise(3000, 8), 1.0);
  const std::span<const double> all{rate};
  OnlineAllan estimator;
  AllanSums expected;
  for (const auto& stretch : {all.first(700), all.subspan(700, 1), all.subspan(701)}) {
    for (const double value : stretch) estimator.step(value);
    estimator.interrupt();
    const AllanSums alone = by_definition(stretch);
    for (std::size_t j = 0; j < kAllanOctaves; ++j) {
      expected.terms[j] += alone.terms[j];
      expected.squares[j] += alone.squares[j];
    }
  }
  expect_equal(estimator.sums(), expected);
}

TEST(OnlineAllan, TakesWhatNoSensorAtRestMeasuresForAGap) {
  const auto rate = gridded(white_noise(400, 9), 1.0);
  for (const double wrong : {33.0, -1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    OnlineAllan with_gap;
    OnlineAllan with_wrong;
    for (std::size_t n = 0; n < rate.size(); ++n) {
      if (n == 150) with_gap.interrupt();
      if (n == 150) with_wrong.step(wrong);
      with_gap.step(rate[n]);
      with_wrong.step(rate[n]);
    }
    EXPECT_EQ(with_wrong.sums(), with_gap.sums()) << wrong;
  }
}

// The integer x wraps around every 2^30 samples of 16 rad/s; neither that nor the bias is to be seen.
TEST(OnlineAllan, DoesNotSeeABiasHoweverLargeAndLong) {
  const auto noise = gridded(white_noise(5000, 10), 1e-3);
  OnlineAllan plain;
  OnlineAllan biased;
  for (std::size_t n = 0; n < 2'000'000; ++n) {
    plain.step(noise[n % noise.size()]);
    biased.step(noise[n % noise.size()] - 31.0);
  }
  EXPECT_EQ(biased.sums(), plain.sums());
}

// A year at 100 Hz has 3e9 terms. What such a sum keeps of one more term is what the compensation is for.
TEST(OnlineAllan, KeepsSmallTermsBesideALargeSum) {
  AllanSums year;
  year.terms.fill(3'000'000'000);
  year.squares.fill(1e6);
  OnlineAllan estimator;
  estimator.restore(year);
  const double step =
      1024.0 * OnlineAllan::kQuantum;  // its square is 3.6e-15, the last place of 1e6 is 1.2e-10
  const std::uint64_t count = 1'000'000;
  for (std::uint64_t n = 0; n < count; ++n) estimator.step(n % 2 == 0 ? 0.0 : step);
  const double added = static_cast<double>(count - 1) * step * step;
  // The sum itself can be told to 1.2e-10.
  EXPECT_NEAR(estimator.sums().squares[0] - 1e6, added, 1.2e-10);
  EXPECT_EQ(estimator.sums().terms[0], 3'000'000'000 + count - 1);
}

TEST(OnlineAllan, GoesOnFromSumsAsAfterAGap) {
  const auto rate = gridded(white_noise(5000, 11), 1.0);
  OnlineAllan whole;
  OnlineAllan second;
  for (std::size_t n = 0; n < rate.size(); ++n) {
    if (n == 2000) {
      second.restore(whole.sums());
      whole.interrupt();
    }
    whole.step(rate[n]);
    if (n >= 2000) second.step(rate[n]);
  }
  expect_equal(second.sums(), whole.sums());
}

TEST(OnlineAllan, AConstantRateHasDeviationZeroAndNoCoefficient) {
  const std::vector<double> rate(1000, 0.123);
  const auto points = allan_points(online(rate), 100.0);
  ASSERT_EQ(points.size(), 9U) << "m = 256 and two clusters of it are 512 samples; 512 would need 1024";
  for (const AllanPoint& point : points) EXPECT_EQ(point.deviation, 0.0);
  EXPECT_FALSE(fit_coefficients(points)[testing::kN].observable);
}

TEST(OnlineAllan, TellsSumsThatCannotBe) {
  const AllanSums good = online(white_noise(500, 12));
  EXPECT_TRUE(is_possible(good));
  EXPECT_TRUE(is_possible({}));
  AllanSums bad = good;
  bad.squares[2] = -1.0;
  EXPECT_FALSE(is_possible(bad));
  bad = good;
  bad.squares[2] = std::nan("");
  EXPECT_FALSE(is_possible(bad));
  bad = good;
  bad.squares[20] = 1.0;
  EXPECT_FALSE(is_possible(bad)) << "a square of no term";
  bad = good;
  bad.terms[3] = bad.terms[2] + 1;
  EXPECT_FALSE(is_possible(bad));
}

}  // namespace
}  // namespace gyrod::core
