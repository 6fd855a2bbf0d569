#include "report/trace.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/report/noise.hpp"

namespace gyrod::report {
namespace {

using ::testing::ElementsAre;

TEST(Trace, AShortSeriesIsDrawnAsItIs) {
  const std::vector<double> x = {3.0, 1.0, 2.0};
  const Trace trace = min_max_trace(x, 0.5, 4);
  EXPECT_EQ(trace.values, x);
  EXPECT_EQ(trace.step, 0.5);
}

TEST(Trace, ALongOneIsTheLeastAndTheGreatestOfEachStretchInTheirOrder) {
  const std::vector<double> x = {1, 5, 2, 4, 3, 0, 7, 7, 7};
  const Trace trace = min_max_trace(x, 0.1, 6);
  EXPECT_THAT(trace.values, ElementsAre(1, 5, 4, 0, 7, 7));
  EXPECT_DOUBLE_EQ(trace.step, 0.15) << "two points for three samples";
}

TEST(Trace, NoSpikeIsLostAndNoMorePointsThanAskedForAreMade) {
  std::vector<double> x = testing::white_noise(100'003, 1.0, 1);
  x[77'777] = 50.0;
  x[11] = -50.0;
  for (const std::size_t most : {2UL, 3UL, 2000UL, 99'999UL}) {
    const Trace trace = min_max_trace(x, 0.01, most);
    EXPECT_LE(trace.values.size(), most);
    EXPECT_EQ(std::ranges::max(trace.values), 50.0) << most;
    EXPECT_EQ(std::ranges::min(trace.values), -50.0) << most;
    // The last stretch may be shorter than the others: the trace ends within one stretch of the record's end.
    const double end = trace.step * static_cast<double>(trace.values.size());
    EXPECT_NEAR(end, 1000.03, 2.0 * trace.step) << most;
  }
}

}  // namespace
}  // namespace gyrod::report
