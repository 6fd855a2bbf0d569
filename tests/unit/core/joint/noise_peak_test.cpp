#include "core/joint/noise_peak.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "line_support.hpp"

namespace gyrod::core {
namespace {

using testing::noise_with_line;

TEST(NoisePeak, FindsFrequencyAndPowerOfALine) {
  const auto peak = find_noise_peak(noise_with_line(0.2, 0.5));
  ASSERT_TRUE(peak);
  EXPECT_NEAR(peak->cycles, 0.2, 1.0 / kNoiseSegment);
  // A resonance has a tenth of its power below the line from foot to foot and beyond: (2 / pi) (h / d) each, h half its width, d 0.06 cycles.
  EXPECT_NEAR(peak->power, 0.9 * 0.5, 0.02 * 0.5);
}

// What the noise is taken apart into makes the noise again.
TEST(NoisePeak, RestAndLineAddUp) {
  const NoiseModel noise = noise_with_line(0.2, 0.5);
  const auto peak = find_noise_peak(noise);
  ASSERT_TRUE(peak);
  EXPECT_NEAR(noise_variance(peak->rest) + peak->power, noise_variance(noise), 1e-6);
  EXPECT_EQ(peak->rest.white_variance, noise.white_variance);
  for (std::size_t k = 0; k < kNoiseBins; k += 8) {
    const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / kNoiseSegment;
    // White noise of 1 and the resonance's feet: what is left has no peak; the peak stood at 17.
    EXPECT_NEAR(noise_spectrum(peak->rest, w), 1.0, 0.15) << k;
  }
}

TEST(NoisePeak, ThereIsNoneInWhiteNoiseNorInASlope) {
  EXPECT_FALSE(find_noise_peak(white_noise(2.0)));
  NoiseModel slope = white_noise(1.0);  // falls to a ninth, as behind a first-order low-pass filter
  slope.colour_order = 1;
  slope.colour[0] = 0.5;
  slope.colour_variance = 1.0;
  EXPECT_FALSE(find_noise_peak(slope));
  EXPECT_FALSE(find_noise_peak({}));
}

// A resonance of power p stands at 1 + 33 p: 2.1 and 3.1 times what is elsewhere.
TEST(NoisePeak, ALineStandsOutTwoAndAHalfTimes) {
  EXPECT_FALSE(find_noise_peak(noise_with_line(0.2, 0.033)));
  EXPECT_TRUE(find_noise_peak(noise_with_line(0.2, 0.065)));
}

TEST(NoisePeak, SlowNoiseIsNotALine) { EXPECT_FALSE(find_noise_peak(noise_with_line(0.005, 3.0))); }

/// What is motion of a broad mode and a narrow one of these powers, beside a line of power 4: {broad, narrow}.
std::array<double, 2> shares(double broad_power, double narrow_power) {
  SpectralMode broad{.drive = broad_power * 0.8};
  SpectralMode narrow{.drive = narrow_power * 0.01};
  std::array<ModeNearLine, 2> modes{{{&broad, broad_power}, {&narrow, narrow_power}}};
  share_with_line(4.0, modes);
  return {broad.share, narrow.share};
}

void expect_shares(double broad_power, double narrow_power, double broad, double narrow) {
  const auto [its_broad, its_narrow] = shares(broad_power, narrow_power);
  EXPECT_NEAR(its_broad, broad, 1e-12) << broad_power << ", " << narrow_power;
  EXPECT_NEAR(its_narrow, narrow, 1e-12) << broad_power << ", " << narrow_power;
}

// A quarter of 4 may be in modes: the narrow mode is asked first, then the broad one for what is left.
TEST(NoisePeak, AQuarterOfTheLinesPowerMayBeInTheNarrowestModes) {
  expect_shares(0.4, 0.6, 0.0, 0.0);
  expect_shares(2.0, 0.4, 1.0, 0.0);              // 0.6 left, and more than twice that is motion
  expect_shares(0.9, 0.4, 1.0 - 0.3 / 0.9, 0.0);  // 0.6 left, one and a half times that: half of it
  expect_shares(0.5, 2.0, 0.0, 1.0);              // twice 1 is motion, and leaves the 1
  expect_shares(3.0, 5.0, 1.0, 1.0);
}

}  // namespace
}  // namespace gyrod::core
