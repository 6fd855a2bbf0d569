#include "core/joint/noise_tracker.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr std::size_t kBins = 513;
constexpr double kShare = 1.0 / 32.0;
using Spectrum = std::vector<double>;

/// `power` everywhere, but `motion` in the first bands.
Spectrum spectrum(double power, double motion = 0.0, std::size_t bands = 0) {
  Spectrum bins(kBins, power);
  const std::size_t end = bands * (kBins - 1) / NoiseTracker::kBands + 1;
  for (std::size_t k = 0; bands > 0 && k < end; ++k) bins[k] += motion;
  return bins;
}

NoiseTracker watched(const Spectrum& power, bool known = true, int windows = 1) {
  NoiseTracker tracker;
  for (int i = 0; i < windows; ++i) tracker.observe(power, Spectrum(kBins, 1.0), known, kShare);
  return tracker;
}

TEST(NoiseTracker, SaysOneWhereTheNoiseIsAsBelieved) {
  EXPECT_DOUBLE_EQ(watched(spectrum(1.0)).level(), 1.0);
  EXPECT_FALSE(watched(spectrum(1.0)).disagrees());
}

TEST(NoiseTracker, FindsALevelBelievedTooLowOrTooHigh) {
  // A deviation believed 20 % too low and 20 % too high: 1 / 0.8^2 and 1 / 1.2^2 in power; what is above 1 is raised to 1.5.
  EXPECT_NEAR(watched(spectrum(1.5625)).level(), std::pow(1.5625, 1.5), 1e-12);
  EXPECT_TRUE(watched(spectrum(1.5625)).disagrees());
  EXPECT_NEAR(watched(spectrum(0.6944)).level(), 0.6944, 1e-12);
  EXPECT_TRUE(watched(spectrum(0.6944)).disagrees());
}

TEST(NoiseTracker, LeavesBandsOutThatHoldMotion) {
  EXPECT_NEAR(watched(spectrum(1.3, 1000.0, 3)).level(), std::pow(1.3, 1.5), 1e-12);
}

TEST(NoiseTracker, DoesNotTakeARoughRoadForNoise) {
  EXPECT_DOUBLE_EQ(watched(spectrum(1.3, 1000.0, 4)).level(), 1.0);
  EXPECT_DOUBLE_EQ(watched(spectrum(50.0)).level(), 1.0);
  EXPECT_FALSE(watched(spectrum(50.0)).disagrees());
}

TEST(NoiseTracker, DoesNotTakeVibrationInSomeBandsForNoise) {
  Spectrum bins = spectrum(1.0, 0.8, 5);
  EXPECT_DOUBLE_EQ(watched(bins).level(), 1.0);
}

TEST(NoiseTracker, FollowsNoFurtherThanToOneHalf) { EXPECT_DOUBLE_EQ(watched(spectrum(1e-6)).level(), 0.5); }

TEST(NoiseTracker, ForgetsWithinSomeWindowsLengths) {
  // A memory of three windows' lengths: after nine more (288 of 32 a window) e^-3 of the old is left.
  NoiseTracker tracker = watched(spectrum(1.5), true, 200);
  for (int i = 0; i < 288; ++i) tracker.observe(spectrum(1.0), Spectrum(kBins, 1.0), true, kShare);
  EXPECT_NEAR(tracker.level(), 1.0, 1.5 * 0.5 * 0.06);
  EXPECT_GT(tracker.level(), 1.0);
}

TEST(NoiseTracker, TakesTheQuietestBandWhereNothingIsKnown) {
  const NoiseTracker tracker = watched(spectrum(4.0, 100.0, 7), false);
  EXPECT_NEAR(tracker.floor(), 4.0 / 0.93, 1e-9);
  EXPECT_FALSE(tracker.disagrees());
}

TEST(NoiseTracker, TakesTheMeanOfTheQuietBandsWhereNothingIsKnown) {
  // Noise of 4 but for one band of 3, its colour, and one of 100, motion.
  Spectrum power = spectrum(4.0, 100.0, 1);
  for (std::size_t k = 7 * (kBins - 1) / 8 + 1; k < kBins; ++k) power[k] = 3.0;
  EXPECT_NEAR(watched(power, false).floor(), (6.0 * 4.0 + 3.0) / 7.0, 0.05);
}

TEST(NoiseTracker, BeginsAnewWhereTheNoiseBecomesKnown) {
  NoiseTracker tracker = watched(spectrum(1.5), false, 100);
  tracker.observe(spectrum(1.0), Spectrum(kBins, 1.0), true, kShare);
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
}

}  // namespace
}  // namespace gyrod::core
