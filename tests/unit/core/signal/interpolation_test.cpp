// The bridge over missing samples.
#include "core/signal/interpolation.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace gyrod {
namespace {

TEST(Bridge, OfThreeSamplesGoesInFourEqualSteps) {
  EXPECT_EQ(core::bridge(1.0, 5.0, 0, 3), 2.0);
  EXPECT_EQ(core::bridge(1.0, 5.0, 1, 3), 3.0);
  EXPECT_EQ(core::bridge(1.0, 5.0, 2, 3), 4.0);
}

TEST(Bridge, OfOneSampleIsTheMiddle) { EXPECT_EQ(core::bridge(-1.0, 2.0, 0, 1), 0.5); }

TEST(Bridge, StaysBetweenItsEnds) {
  for (std::size_t step = 0; step < 100; ++step) {
    const double value = core::bridge(-0.3, 0.1, step, 100);
    EXPECT_GT(value, -0.3);
    EXPECT_LT(value, 0.1);
  }
}

// Their difference is beyond the largest double.
TEST(Bridge, IsFiniteBetweenTheLargestNumbersOfEitherSign) {
  constexpr double kMax = std::numeric_limits<double>::max();
  for (std::size_t step = 0; step < 7; ++step) {
    EXPECT_TRUE(std::isfinite(core::bridge(-kMax, kMax, step, 7)));
  }
}

}  // namespace
}  // namespace gyrod
