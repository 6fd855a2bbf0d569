#include "core/noise/line_spread.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

double total(const NoiseSpectrum& power) { return std::accumulate(power.begin(), power.end(), 0.0); }

TEST(SpreadLines, LeavesWhiteNoiseAlone) {
  NoiseSpectrum white{};
  white.fill(3.0);
  const NoiseSpectrum spread = spread_lines(white);
  for (const double power : spread) EXPECT_NEAR(power, 3.0, 1e-12);
}

TEST(SpreadLines, LeavesTheLowestBinsAlone) {
  // 0.15 of bin 3 is less than half a bin. The whole keeps its power by a factor that is 1 only where the slope is even, so the ratio counts.
  NoiseSpectrum falling{};
  for (std::size_t k = 0; k < kNoiseBins; ++k) falling[k] = 1.0 / (1.0 + static_cast<double>(k));
  const NoiseSpectrum spread = spread_lines(falling);
  for (std::size_t k = 1; k <= 3; ++k)
    EXPECT_NEAR(spread[k] / spread[0], falling[k] / falling[0], 1e-12) << k;
}

TEST(SpreadLines, SpreadsALineOverAllPlacesItMayMoveTo) {
  // A line at bin 100 reaches the bins k with |k - 100| <= round(0.15 k): 87 to 118.
  NoiseSpectrum line{};
  line[100] = 1.0;
  const NoiseSpectrum spread = spread_lines(line);
  EXPECT_NEAR(total(spread), 1.0, 1e-12);
  for (std::size_t k = 0; k < kNoiseBins; ++k) {
    if (k >= 87 && k <= 118) {
      EXPECT_NEAR(spread[k], 1.0 / 32.0, 0.2 / 32.0) << k;
    } else {
      EXPECT_EQ(spread[k], 0.0) << k;
    }
  }
}

TEST(SpreadLines, KeepsThePowerOfALineAtTheEdge) {
  NoiseSpectrum line{};
  line.fill(0.1);
  line[kNoiseBins - 1] = 20.0;
  EXPECT_NEAR(total(spread_lines(line)), total(line), 1e-9);
}

TEST(SpreadLines, ASpectrumWithoutPowerStaysSo) { EXPECT_EQ(spread_lines(NoiseSpectrum{}), NoiseSpectrum{}); }

}  // namespace
}  // namespace gyrod::core
