#include "core/joint/noise_tracker.hpp"

#include <cmath>
#include <numbers>
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
  const std::size_t end = bands * (kBins - 1) / kNoiseBands + 1;
  for (std::size_t k = 0; bands > 0 && k < end; ++k) bins[k] += motion;
  return bins;
}

/// Noise whose colour is believed, too.
NoiseModel coloured(double level = 1.0) {
  NoiseModel noise = white_noise(0.5 * level);
  noise.colour_order = 1;
  noise.colour[0] = 0.1;
  noise.colour_variance = 0.5 * level;
  return noise;
}

void watch(NoiseTracker& tracker, const Spectrum& power, int windows,
           const NoiseModel& believed = coloured()) {
  for (int i = 0; i < windows; ++i) tracker.observe(power, Spectrum(kBins, 1.0), believed, kShare, kShare);
}

NoiseTracker watched(const Spectrum& power, const NoiseModel& believed = coloured()) {
  NoiseTracker tracker;
  watch(tracker, power, 1, believed);
  return tracker;
}

TEST(NoiseTracker, TellsWhatIsBelieved) {
  EXPECT_EQ(belief_in({}), NoiseBelief::kNothing);
  EXPECT_EQ(belief_in(white_noise(0.1)), NoiseBelief::kLevel);
  EXPECT_EQ(belief_in(coloured()), NoiseBelief::kColour);
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
  // All bands hold motion, twice as much in some of them as in others.
  EXPECT_DOUBLE_EQ(watched(spectrum(50.0, 50.0, 5)).level(), 1.0);
  EXPECT_FALSE(watched(spectrum(50.0, 50.0, 5)).disagrees());
}

// A calibration of another sensor, or in another unit. No road has the colour of the noise in so many bands; what lies above it is motion.
TEST(NoiseTracker, FindsALevelBelievedManyTimesTooLow) {
  for (const NoiseModel& believed : {coloured(), white_noise(1.0)}) {
    for (const double level : {2.5, 4.0, 100.0}) {
      for (const double motion : {0.0, 30.0}) {
        NoiseTracker tracker;
        watch(tracker, spectrum(level, motion * level, 3), 96, believed);
        EXPECT_NEAR(tracker.level(), level, 0.12 * level) << motion;
        EXPECT_TRUE(tracker.disagrees());
        // Until a band is as quiet as it is believed to be.
        watch(tracker, spectrum(1.0), 2000, believed);
        EXPECT_NEAR(tracker.level(), 1.0, 0.05) << level;
      }
    }
  }
}

// What an idling engine shakes before a car drives off: its quietest moment is the first, shorter than a window.
TEST(NoiseTracker, RemembersAQuietMomentBeforeTheFirstWindowIsFull) {
  for (const NoiseModel& believed : {coloured(), white_noise(1.0)}) {
    NoiseTracker tracker;
    watch(tracker, spectrum(1.0), 14, believed);
    watch(tracker, spectrum(30.0), 400, believed);
    EXPECT_LT(tracker.level(), 2.5);
  }
}

TEST(NoiseTracker, FindsALevelBelievedManyTimesTooHigh) {
  for (const NoiseModel& believed : {coloured(), white_noise(1.0)}) {
    NoiseTracker tracker;
    watch(tracker, spectrum(0.04, 1.0, 3), 64, believed);
    EXPECT_NEAR(tracker.level(), 0.04, 0.005);
    EXPECT_TRUE(tracker.disagrees());
  }
}

/// Shakes every band, and differently.
Spectrum very_rough_road() {
  Spectrum road = spectrum(1.0);
  for (std::size_t k = 0; k < kBins; ++k) road[k] += 400.0 * std::exp(-static_cast<double>(k) / 120.0);
  return road;
}

TEST(NoiseTracker, KeepsWhatIsBelievedOnAVeryRoughRoad) {
  const Spectrum road = very_rough_road();
  NoiseTracker tracker;
  watch(tracker, road, 320);
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
  NoiseTracker told;
  watch(told, road, 320, white_noise(1.0));
  EXPECT_LT(told.level(), 3.5) << "6.6 is the quietest bin";
}

TEST(NoiseTracker, DoesNotTakeVibrationInSomeBandsForNoise) {
  Spectrum bins = spectrum(1.0, 0.8, 5);
  EXPECT_DOUBLE_EQ(watched(bins).level(), 1.0);
}

TEST(NoiseTracker, FollowsNoFurtherThanToAThousandth) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1e-6), 64);
  EXPECT_DOUBLE_EQ(tracker.level(), 1e-3);
}

TEST(NoiseTracker, ForgetsWithinSomeWindowsLengths) {
  // A memory of three windows' lengths: after nine more (288 of 32 a window) e^-3 of the old is left.
  NoiseTracker tracker;
  watch(tracker, spectrum(0.6), 200);
  watch(tracker, spectrum(1.0), 288);
  EXPECT_NEAR(tracker.level(), 1.0, 0.4 * 0.06);
  EXPECT_LT(tracker.level(), 1.0);
}

// A road that shakes every band by half as much as the noise, for a minute and more, after a quiet moment.
TEST(NoiseTracker, RemembersHowQuietItHasBeen) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 96);
  watch(tracker, spectrum(1.5), 160);
  EXPECT_LE(tracker.level(), std::pow(1.15 * std::exp(0.05), 1.5));
  EXPECT_GE(tracker.level(), std::pow(1.15, 1.5));
  EXPECT_FALSE(tracker.disagrees());
}

TEST(NoiseTracker, BelievesNoiseThatStaysStronger) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 96);
  watch(tracker, spectrum(1.5), 32 * 60);
  EXPECT_NEAR(tracker.level(), 1.5, 1e-6);
  EXPECT_TRUE(tracker.disagrees());
}

// Ten times the power from one minute to the next, as of a sensor that is failing: told at once, whatever is made of it.
TEST(NoiseTracker, SaysAtOnceThatAllBandsHaveBecomeLouder) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 96);
  EXPECT_FALSE(tracker.disagrees());
  watch(tracker, spectrum(10.0), 32);
  EXPECT_LT(tracker.level(), 1.4);
  EXPECT_TRUE(tracker.disagrees());
  EXPECT_GT(tracker.shown_level(), 3.0) << "what is told: a third of three windows' memory has it";
  watch(tracker, spectrum(1.0), 32 * 8);
  EXPECT_EQ(tracker.shown_level(), tracker.level());
  EXPECT_FALSE(tracker.disagrees());
  watch(tracker, spectrum(1.0, 9.0, 5), 32 * 8);
  EXPECT_FALSE(tracker.disagrees()) << "what shakes leaves some bands as they were";
}

// Where a sensor's low-pass stops, a model of it is off by any factor; that says nothing of the level.
TEST(NoiseTracker, JudgesNothingWhereALowPassStops) {
  Spectrum believed(kBins, 1.0);
  Spectrum seen(kBins, 1.0);
  for (std::size_t k = kBins / 2; k < kBins; ++k) {
    believed[k] = 0.02;
    seen[k] = 0.002;
  }
  NoiseTracker tracker;
  for (int i = 0; i < 96; ++i) tracker.observe(seen, believed, coloured(), kShare, kShare);
  EXPECT_NEAR(tracker.level(), 1.0, 0.01);
  EXPECT_FALSE(tracker.disagrees());
  for (double& power : seen) power *= 0.25;
  for (int i = 0; i < 32 * 30; ++i) tracker.observe(seen, believed, coloured(), kShare, kShare);
  EXPECT_NEAR(tracker.level(), 0.25, 0.01) << "where it passes, the level is judged as ever";
}

// Of which nothing is known, and which has become twice as strong: 4 / 1.15 = 1.03^42.
TEST(NoiseTracker, BelievesUnknownNoiseThatDoublesWithinFortyWindows) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 96, {});
  watch(tracker, spectrum(4.0), 32 * 20, {});
  EXPECT_LT(tracker.level(), 2.5);
  watch(tracker, spectrum(4.0), 32 * 22, {});
  EXPECT_NEAR(tracker.level(), 4.0, 0.1);
}

// Windows of half a second follow one another as quickly as those of nine; what shakes for a minute is not noise for that.
TEST(NoiseTracker, ForgetsByTheSecondNotByTheWindow) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 96, {});
  const double before = tracker.level();
  for (int i = 0; i < 32 * 40; ++i)
    tracker.observe(spectrum(4.0), Spectrum(kBins, 1.0), {}, kShare, kShare / 16.0);
  EXPECT_LT(tracker.level(), 1.3 * before);
}

// The sensor is as it was; half as much noise is believed from now on.
TEST(NoiseTracker, RestatesWhatItKnowsWhereAnotherModelIsBelieved) {
  NoiseTracker tracker;
  watch(tracker, spectrum(0.7), 96, coloured(2.0));
  watch(tracker, spectrum(1.4), 1, coloured(1.0));
  EXPECT_NEAR(tracker.level(), std::pow(1.4, 1.5), 1e-9);
  watch(tracker, spectrum(1.4), 1, {});
  EXPECT_NEAR(tracker.level(), 1.4, 0.02);
}

// Numbers that overflow are forgotten with the next window.
TEST(NoiseTracker, IsWellAgainAfterWhatIsNotFinite) {
  NoiseTracker tracker;
  watch(tracker, spectrum(1.0), 10, coloured(1e300));
  watch(tracker, spectrum(1.0), 1, coloured(1e-300));
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
  watch(tracker, spectrum(1e308), 1, coloured(1e-300));
  watch(tracker, spectrum(0.7), 200, coloured(1e-300));
  EXPECT_NEAR(tracker.level(), 0.7, 0.1);
}

/// Bands that are `apart` times as strong from one to the next but one.
Spectrum staircase(double least, double apart) {
  Spectrum power(kBins);
  for (std::size_t k = 0; k < kBins; ++k)
    power[k] =
        least * std::pow(apart, 0.5 * std::floor(static_cast<double>(k - (k > 0)) * 8.0 / (kBins - 1)));
  return power;
}

// Bands that were alike within 1.25 are noise as long as they are within 1.6, three of eight steps of 1.15; a road's are not, however loud all of them are.
TEST(NoiseTracker, KeepsAFarLevelForAsLongAsBandsAreNearlyAlike) {
  NoiseTracker tracker;
  watch(tracker, spectrum(100.0), 64);
  watch(tracker, staircase(80.0, 1.15 * 1.15), 320);
  EXPECT_GT(tracker.level(), 40.0);
  watch(tracker, very_rough_road(), 320);
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0) << "6.6 is its quietest bin";
}

// It is in parts of what was believed: with another belief it is over.
TEST(NoiseTracker, KeepsNoFarLevelInPartsOfAnotherBelief) {
  NoiseTracker tracker;
  watch(tracker, spectrum(100.0), 64);
  watch(tracker, staircase(80.0, 1.15 * 1.15), 320);
  ASSERT_GT(tracker.level(), 40.0);
  watch(tracker, staircase(80.0, 1.15 * 1.15), 1, coloured(1.01));
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
}

// Until a window's length has been seen, all bands may be of one bump.
TEST(NoiseTracker, SaysNothingOfLouderBandsBeforeAWindowsLength) {
  NoiseTracker tracker;
  watch(tracker, spectrum(10.0), 31);
  EXPECT_EQ(tracker.shown_level(), 1.0);
  EXPECT_FALSE(tracker.disagrees());
  watch(tracker, spectrum(10.0), 1);
  EXPECT_NEAR(tracker.shown_level(), 10.0, 0.1);
  EXPECT_TRUE(tracker.disagrees());
}

TEST(NoiseTracker, FindsTheColourWhereOnlyALevelIsBelieved) {
  Spectrum power(kBins);
  const NoiseModel noise = noise_of({.level = 1.5625, .tilt = 0.7});
  for (std::size_t k = 0; k < kBins; ++k)
    power[k] = noise_spectrum(noise, std::numbers::pi * static_cast<double>(k) / (kBins - 1));
  const NoiseTracker tracker = watched(power, white_noise(1.0));
  EXPECT_NEAR(tracker.shape().level, 1.5625, 0.05);
  EXPECT_NEAR(tracker.shape().tilt, 0.7, 0.07);
  EXPECT_TRUE(tracker.disagrees());
}

TEST(NoiseTracker, TakesTheQuietBandsWhereNothingIsKnown) {
  const NoiseTracker tracker = watched(spectrum(4.0, 100.0, 2), {});
  EXPECT_NEAR(tracker.level(), 4.0, 0.4);
  EXPECT_FALSE(tracker.disagrees());
}

}  // namespace
}  // namespace gyrod::core
