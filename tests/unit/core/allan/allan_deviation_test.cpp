// The overlapping estimator against closed forms and published data sets.
#include "core/allan/allan_deviation.hpp"

#include <cstdint>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "allan_support.hpp"
#include "core/signal/moments.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::allan_deviation;
using core::allan_deviation_at;
using core::AllanPoint;
using ::testing::ElementsAre;

double deviation_at(const Signal& rate, std::size_t m) {
  return allan_deviation_at(rate, 1.0, std::vector{m}).at(0).deviation;
}

Signal nbs_1000() {
  Signal x;
  std::uint64_t n = 1234567890;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(static_cast<double>(n) / 2147483647.0);
    n = 16807 * n % 2147483647;
  }
  return x;
}

// NIST SP 1065, table of the 1000-point test suite (NBS Monograph 140, annex 8.E): seven digits.
TEST(AllanDeviation, MeetsTheNbsThousandPoints) {
  EXPECT_NEAR(deviation_at(nbs_1000(), 1), 0.2922319, 5e-8);
  EXPECT_NEAR(deviation_at(nbs_1000(), 10), 0.09159953, 5e-9);
  EXPECT_NEAR(deviation_at(nbs_1000(), 100), 0.03241343, 5e-9);
}

// NIST SP 1065, table of the nine-point data set: seven digits.
TEST(AllanDeviation, MeetsTheNbsNinePoints) {
  const Signal x = {892, 809, 823, 798, 671, 644, 883, 903, 677};
  EXPECT_NEAR(deviation_at(x, 1), 91.22945, 5e-6);
  EXPECT_NEAR(deviation_at(x, 2), 85.95287, 5e-6);
}

// Every z_k of a ramp with slope 1 per sample is m^2; all sums are whole or half numbers, so nothing rounds but
// the root.
TEST(AllanDeviation, OfARampIsTauOverRootTwo) {
  Signal ramp(1000);
  std::iota(ramp.begin(), ramp.end(), 0.0);
  for (const AllanPoint& point : allan_deviation(ramp, 1.0, {.longest_part = 0.5})) {
    EXPECT_DOUBLE_EQ(point.deviation * point.deviation, 0.5 * point.tau_s * point.tau_s);
  }
}

/// The definition with cluster means, without cumulative sums: NIST SP 1065, from frequency data.
double by_definition(const Signal& rate, std::size_t m) {
  double sum = 0.0;
  const std::size_t terms = rate.size() - 2 * m + 1;
  for (std::size_t k = 0; k < terms; ++k) {
    const double first = core::mean(std::span(rate).subspan(k, m));
    const double second = core::mean(std::span(rate).subspan(k + m, m));
    sum += (second - first) * (second - first);
  }
  return std::sqrt(sum / (2.0 * static_cast<double>(terms)));
}

// Rounding of 500 additions: some 1e-14.
TEST(AllanDeviation, AgreesWithItsDefinitionForEveryClusterSize) {
  for (const std::size_t size : {3U, 8U, 17U, 251U}) {
    const Signal rate = sum(random_walk(size, 5), Signal(size, 40.0));
    for (std::size_t m = 1; 2 * m <= size; ++m) {
      EXPECT_NEAR(deviation_at(rate, m), by_definition(rate, m), 1e-11) << size << " " << m;
    }
  }
}

TEST(AllanDeviation, PointsCarryTimesAndCounts) {
  const auto points = allan_deviation_at(white_noise(1000, 1), 50.0, std::vector<std::size_t>{1, 20, 500});
  ASSERT_EQ(points.size(), 3U);
  EXPECT_DOUBLE_EQ(points[1].tau_s, 0.4);
  EXPECT_EQ(points[1].cluster_samples, 20U);
  EXPECT_EQ(points[1].terms, 961U);
  EXPECT_EQ(points[2].terms, 1U);
  for (const AllanPoint& point : points) {
    EXPECT_LT(point.lower, point.deviation);
    EXPECT_GT(point.upper, point.deviation);
    EXPECT_GE(point.edf, 1.0);
  }
}

// An offset of 1e6 costs six of sixteen digits of every sample.
TEST(AllanDeviation, DoesNotSeeAnOffsetAndScales) {
  const Signal rate = white_noise(4000, 2);
  const auto plain = allan_deviation(rate, 100.0);
  const auto moved = allan_deviation(sum(rate, Signal(rate.size(), 1e6)), 100.0);
  const auto scaled = allan_deviation(times(rate, -4.0), 100.0);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(moved[i].deviation, plain[i].deviation, 1e-8 * plain[i].deviation);
    EXPECT_EQ(scaled[i].deviation, 4.0 * plain[i].deviation) << "a power of two changes no bit";
    EXPECT_EQ(scaled[i].edf, plain[i].edf);
  }
}

TEST(AllanDeviation, OfAConstantIsZeroWithoutAnyInterval) {
  for (const AllanPoint& point : allan_deviation(Signal(500, 0.1), 100.0)) {
    EXPECT_EQ(point.deviation, 0.0);
    EXPECT_EQ(point.lower, 0.0);
    EXPECT_EQ(point.upper, 0.0);
  }
}

TEST(AllanDeviation, OfFewerThanThreeSamplesIsNotThere) {
  EXPECT_TRUE(allan_deviation(Signal{}, 1.0).empty());
  EXPECT_TRUE(allan_deviation(Signal{1.0, 2.0}, 1.0).empty());
  const auto three = allan_deviation(Signal{1.0, 2.0, 4.0}, 1.0);
  ASSERT_EQ(three.size(), 1U);
  EXPECT_DOUBLE_EQ(three[0].deviation, std::sqrt((1.0 + 4.0) / 4.0));  // differences 1 and 2, by hand
}

TEST(AllanDeviation, LeavesOutClustersThatTheRecordCannotHoldTwice) {
  const auto points = allan_deviation_at(white_noise(9, 1), 1.0, std::vector<std::size_t>{4, 5, 1000});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].cluster_samples, 4U);
}

TEST(ClusterSizes, AreLogSpacedWithoutRepeatsUpToThePart) {
  EXPECT_THAT(core::cluster_sizes(200, {.points_per_decade = 4}), ElementsAre(1, 2, 3, 6, 10, 18));
  EXPECT_THAT(core::cluster_sizes(200, {.longest_part = 0.5, .points_per_decade = 4}),
              ElementsAre(1, 2, 3, 6, 10, 18, 32, 56, 100));
  EXPECT_THAT(core::cluster_sizes(5, {}), ElementsAre(1));
  EXPECT_TRUE(core::cluster_sizes(2, {}).empty());
}

}  // namespace
}  // namespace gyrod
