#include "stream/period_estimator.hpp"

#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace gyrod::stream {
namespace {

constexpr std::int64_t kMedianNs = 10'000'000;

/// 64 intervals, of which so many are `other`.
void add_all(PeriodEstimator& estimator, std::size_t others, std::int64_t other_ns) {
  for (std::size_t n = 0; n < PeriodEstimator::kIntervals; ++n)
    estimator.add(n < others ? other_ns : kMedianNs);
}

TEST(PeriodEstimator, KnowsNothingBeforeItsIntervalsAreFull) {
  PeriodEstimator estimator(0.0);
  for (std::size_t n = 1; n < PeriodEstimator::kIntervals; ++n) estimator.add(kMedianNs);
  EXPECT_EQ(estimator.rate_hz(), 0.0);
  EXPECT_FALSE(estimator.regular());
  estimator.add(kMedianNs);
  EXPECT_DOUBLE_EQ(estimator.rate_hz(), 100.0);
  EXPECT_TRUE(estimator.regular());
}

// 58 of 64 within a quarter of the median: six may be off.
TEST(PeriodEstimator, TrustsStampsOfWhichSixAreOff) {
  PeriodEstimator six(0.0);
  add_all(six, 6, 2 * kMedianNs);
  EXPECT_TRUE(six.regular());
  EXPECT_DOUBLE_EQ(six.period_ns(), static_cast<double>(kMedianNs)) << "of those that are not off";
  PeriodEstimator seven(0.0);
  add_all(seven, 7, 2 * kMedianNs);
  EXPECT_FALSE(seven.regular());
  EXPECT_DOUBLE_EQ(seven.period_ns(), (1.0 + 7.0 / 64.0) * static_cast<double>(kMedianNs)) << "of all";
}

TEST(PeriodEstimator, AnIntervalIsOffFromAQuarterOfTheMedianOn) {
  PeriodEstimator within(0.0);
  add_all(within, 32, kMedianNs * 124 / 100);
  EXPECT_TRUE(within.regular());
  PeriodEstimator beyond(0.0);
  add_all(beyond, 7, kMedianNs * 126 / 100);
  EXPECT_FALSE(beyond.regular());
}

// No loss makes an interval shorter: from half the median on it is a host that has stamped late. The next intervals know nothing of it.
TEST(PeriodEstimator, TrustsNoStampsOfWhichOneIsFarTooEarly) {
  PeriodEstimator estimator(0.0);
  add_all(estimator, 1, kMedianNs * 51 / 100);
  EXPECT_TRUE(estimator.regular());
  add_all(estimator, 1, kMedianNs * 49 / 100);
  EXPECT_FALSE(estimator.regular());
  add_all(estimator, 0, 0);
  EXPECT_TRUE(estimator.regular());
}

TEST(PeriodEstimator, AConfiguredRateStays) {
  PeriodEstimator estimator(200.0);
  EXPECT_DOUBLE_EQ(estimator.rate_hz(), 200.0);
  EXPECT_TRUE(estimator.regular());
  add_all(estimator, 0, 0);
  EXPECT_DOUBLE_EQ(estimator.rate_hz(), 200.0);
}

}  // namespace
}  // namespace gyrod::stream
