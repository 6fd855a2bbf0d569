// Moments against sums done by hand and against identities.
#include "core/signal/moments.hpp"

#include <array>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

TEST(Moments, OfNothingAreZero) {
  EXPECT_EQ(core::mean({}), 0.0);
  EXPECT_EQ(core::variance({}), 0.0);
  EXPECT_EQ(core::mean_square({}), 0.0);
}

// 1, 2, 3, 4: mean 10 / 4, squares 30 / 4, variance 30 / 4 - (10 / 4)^2 = 5 / 4.
TEST(Moments, OfFourNumbersAreThoseDoneByHand) {
  const std::array x{1.0, 2.0, 3.0, 4.0};
  EXPECT_EQ(core::mean(x), 2.5);
  EXPECT_EQ(core::mean_square(x), 7.5);
  EXPECT_EQ(core::variance(x), 1.25);
}

// One pass, mean of squares less square of the mean, would lose all digits here.
TEST(Moments, VarianceSurvivesALargeOffset) {
  const std::array x{1e9 + 1.0, 1e9 + 2.0, 1e9 + 3.0, 1e9 + 4.0};
  EXPECT_EQ(core::variance(x), 1.25);
}

// Sums of equal numbers round: a mean that differs from them in the last place would make noise of a
// constant.
TEST(Moments, ConstantHasItselfForMeanAndNoVariance) {
  for (const double level : {0.1, -0.731, 1e-300, 1e300}) {
    for (const std::size_t size : {3U, 10U, 1000U, 1024U}) {
      const Signal constant(size, level);
      EXPECT_EQ(core::mean(constant), level) << size;
      EXPECT_EQ(core::variance(constant), 0.0) << level << ", " << size;
    }
  }
}

// x = 1..5, y = 2 1 4 3 5: sum dx dy = 8, sums of squares 10 and 10.
TEST(PearsonCorrelation, IsTheOneDoneByHand) {
  const std::array x{1.0, 2.0, 3.0, 4.0, 5.0};
  const std::array y{2.0, 1.0, 4.0, 3.0, 5.0};
  EXPECT_NEAR(core::pearson_correlation(x, y), 0.8, 1e-15);
}

TEST(PearsonCorrelation, IsOneForEveryRisingLineAndMinusOneForEveryFallingOne) {
  const Signal x = white_noise(100, 1);
  const Signal offset(x.size(), 7.0);
  EXPECT_NEAR(core::pearson_correlation(x, sum(offset, x, 1e-3)), 1.0, 1e-12);
  EXPECT_NEAR(core::pearson_correlation(x, sum(offset, x, -1e3)), -1.0, 1e-12);
  EXPECT_LE(core::pearson_correlation(x, x), 1.0);
}

TEST(PearsonCorrelation, WithAConstantIsZero) {
  const Signal x = white_noise(10, 2);
  EXPECT_EQ(core::pearson_correlation(x, Signal(10, 0.1)), 0.0);
  EXPECT_EQ(core::pearson_correlation(Signal(10, 0.1), x), 0.0);
}

// The sums of squares of these would leave the range of double if they were multiplied first.
TEST(PearsonCorrelation, HoldsForTinyAndHugeNumbers) {
  const Signal x = white_noise(50, 3);
  for (const double scale : {1e-150, 1e-100, 1e100, 1e150}) {
    EXPECT_NEAR(core::pearson_correlation(times(x, scale), times(x, scale)), 1.0, 1e-15) << scale;
  }
}

TEST(MeanPeriod, OfAToneIsItsPeriod) {
  // 50 periods of 20 samples: 100 half-waves, of which the first has no sign change before it.
  EXPECT_NEAR(core::mean_period(tone(1000, 0.05, -1.5)), 20.0, 20.0 / 99.0);
}

TEST(MeanPeriod, TakesAZeroForTheSignBeforeIt) {
  EXPECT_EQ(core::mean_period(std::array{1.0, 0.0, -1.0, 0.0, 0.0, -1.0, 1.0, 0.0}), 2.0 * 8.0 / 2.0);
}

TEST(MeanPeriod, WithoutASignChangeIsTwiceTheLength) {
  EXPECT_EQ(core::mean_period(Signal(10, 3.0)), 20.0);
  EXPECT_EQ(core::mean_period(Signal(10, 0.0)), 20.0);
}

}  // namespace
}  // namespace gyrod
