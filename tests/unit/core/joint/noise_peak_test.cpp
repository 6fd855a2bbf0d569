#include "core/joint/noise_peak.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr std::size_t kBins = 1025;

/// White of 1, and a line as wide as five bins in the middle of which 1 + height stands.
std::vector<double> with_line(double cycles, double height) {
  std::vector<double> spectrum(kBins, 1.0);
  const auto middle = static_cast<std::size_t>(std::lround(2.0 * cycles * (kBins - 1)));
  for (std::size_t k = middle - 2; k <= middle + 2; ++k) spectrum[k] += height * (k == middle ? 1.0 : 0.5);
  return spectrum;
}

TEST(NoisePeak, FindsFrequencyAndPowerOfALine) {
  // The line's variance is its mean over all bins: (1 + 4 * 0.5) * 400 / 1025.
  const NoisePeak peak = noise_peak(with_line(0.2, 400.0));
  EXPECT_NEAR(peak.cycles, 0.2, 0.5 / (kBins - 1));
  EXPECT_NEAR(peak.power, 3.0 * 400.0 / kBins, 1e-9);
}

TEST(NoisePeak, ThereIsNoneInWhiteNoiseNorInASlope) {
  EXPECT_EQ(noise_peak(std::vector<double>(kBins, 2.0)).power, 0.0);
  std::vector<double> slope(kBins);  // falls to a quarter, as behind a first-order low-pass filter
  for (std::size_t k = 0; k < kBins; ++k) slope[k] = 1.0 / (1.0 + 3.0 * static_cast<double>(k) / (kBins - 1));
  EXPECT_EQ(noise_peak(slope).power, 0.0);
}

TEST(NoisePeak, SlowNoiseIsNotALine) {
  std::vector<double> flicker(kBins, 1.0);
  for (std::size_t k = 1; k < kBins; ++k) flicker[k] += 30.0 / static_cast<double>(k);
  EXPECT_EQ(noise_peak(flicker).power, 0.0);
}

TEST(NoisePeak, KnowsItsSurroundings) {
  const NoisePeak peak = noise_peak(with_line(0.2, 400.0));
  EXPECT_EQ(peak.surroundings, 1.0);
  EXPECT_NEAR(static_cast<double>(peak.first_bin), 0.15 * 2.0 * (kBins - 1), 1.0);
  EXPECT_NEAR(static_cast<double>(peak.end_bin), 0.25 * 2.0 * (kBins - 1), 2.0);
}

TEST(NoisePeak, ReachesAQuarterOfItsFrequency) {
  const NoisePeak peak{.cycles = 0.2, .power = 3.0};
  EXPECT_TRUE(peak.reaches(0.151));
  EXPECT_TRUE(peak.reaches(0.249));
  EXPECT_FALSE(peak.reaches(0.149));
  EXPECT_FALSE(peak.reaches(0.251));
  EXPECT_FALSE(NoisePeak{}.reaches(0.0));
}

/// What is motion of a broad mode of power 2 and a narrow one of power 3, beside a line of power 4, when so much is expected to be where it
/// is believed to be: {broad, narrow}.
std::array<double, 2> shares(double expected) {
  SpectralMode broad{.drive = 2.0 * 0.8};
  SpectralMode narrow{.drive = 3.0 * 0.01};
  std::array<ModeNearLine, 2> modes{{{&broad, 2.0}, {&narrow, 3.0}}};
  share_with_line(NoisePeak{.cycles = 0.2, .power = 4.0}, expected, modes);
  return {broad.share, narrow.share};
}

void expect_shares(double expected, double broad, double narrow) {
  const auto [its_broad, its_narrow] = shares(expected);
  EXPECT_NEAR(its_broad, broad, 1e-12) << expected;
  EXPECT_NEAR(its_narrow, narrow, 1e-12) << expected;
}

// The line has 4, or up to 5 = 1.25 times 4 where that explains a mode; and the narrow mode is asked first.
TEST(NoisePeak, WhatTheLineMayHaveElsewhereIsInTheNarrowestModes) {
  expect_shares(0.0, 0.0, 0.0);  // 5 may be missing: all of the modes
  // 4 may be: the narrow one; of the 1 that is left then the broad one is twice as much, and nothing is missing.
  expect_shares(1.0, 1.0, 0.0);
  expect_shares(5.0, 1.0, 1.0);   // nothing
  expect_shares(50.0, 1.0, 1.0);  // motion at the line's frequency
  // After the narrow mode 1.5 may be missing and 0.5 is; the broad one has 4/3 of 1.5: a third of the way from one to the other.
  expect_shares(0.5, 1.0 - (1.5 - 1.0 / 3.0) / 2.0, 0.0);
  // 1.5 may be missing and 0.5 is: that, as the narrow mode is twice as much. Of the 1 that is left then the broad one is twice as much.
  expect_shares(3.5, 1.0, 1.0 - 0.5 / 3.0);
}

}  // namespace
}  // namespace gyrod::core
