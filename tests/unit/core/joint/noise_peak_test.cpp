#include "core/joint/noise_peak.hpp"

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

TEST(NoisePeak, MayBeAnywhereWithinAQuarterOfItsFrequencyAndTwiceAsStrong) {
  const NoisePeak peak{.cycles = 0.2, .power = 3.0};
  EXPECT_TRUE(peak.may_be(0.2, 3.0));
  EXPECT_TRUE(peak.may_be(0.151, 0.1));
  EXPECT_TRUE(peak.may_be(0.249, 5.9));
  EXPECT_FALSE(peak.may_be(0.149, 1.0));
  EXPECT_FALSE(peak.may_be(0.251, 1.0));
  EXPECT_FALSE(peak.may_be(0.2, 6.1));
  EXPECT_FALSE(NoisePeak{}.may_be(0.0, 0.0));
}

}  // namespace
}  // namespace gyrod::core
