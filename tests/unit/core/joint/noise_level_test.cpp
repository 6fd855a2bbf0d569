// Which level the tracker finds in bands of given strength, by the rules of docs/joint.md, "When the noise is not as believed".
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "core/joint/noise_tracker.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

/// So many thirty-seconds of a window of noise whose level and colour are believed, bands in parts of that.
void observe(NoiseTracker& tracker, const BandPower& bands, int times) {
  constexpr std::size_t kPerBand = 64;
  std::vector<double> power(kNoiseBands * kPerBand + 1, bands[0]);
  for (std::size_t band = 0; band < kNoiseBands; ++band)
    std::fill_n(power.begin() + static_cast<std::ptrdiff_t>(band * kPerBand + 1), kPerBand, bands[band]);
  NoiseModel believed = white_noise(0.9);
  believed.colour_order = 1;
  believed.colour[0] = 0.1;
  believed.colour_variance = 0.1;
  for (int i = 0; i < times; ++i)
    tracker.observe(power, std::vector<double>(power.size(), 1.0), believed, 1.0 / 32.0, 1.0 / 32.0);
}

/// After three windows' lengths.
NoiseTracker after_bands(const BandPower& bands) {
  NoiseTracker tracker;
  observe(tracker, bands, 96);
  return tracker;
}

double level_of_bands(const BandPower& bands) { return after_bands(bands).level(); }

// A gap leaves what the tracker knows and makes windows short: noise is restless in them because they hold little of it.
TEST(NoiseLevel, OfASensorThatIsLouderThanBelievedOutlastsGaps) {
  constexpr std::size_t kLongest = 1024;
  constexpr std::size_t kStretch = 256;
  constexpr double kLouder = 1.3;
  core::NoiseModel believed = core::white_noise(0.9);
  believed.colour_order = 1;
  believed.colour[0] = 0.1;
  believed.colour_variance = 0.1;
  const auto seen = testing::times(testing::white_noise(40 * kStretch, 7), std::sqrt(kLouder));
  JointFit fit(kLongest);
  JointModel model;
  WindowReport report;
  const auto take = [&](std::size_t begin, std::size_t longest) {
    for (std::size_t size = JointFit::kMinSamples; size <= longest; size += 32)
      fit.fit(std::span(seen).subspan(begin, size), believed, model, report);
  };
  for (std::size_t begin = 0; begin + kLongest <= seen.size() / 2; begin += kLongest) take(begin, kLongest);
  const double before = model.noise.level();
  ASSERT_GT(before, 1.2);
  for (std::size_t begin = seen.size() / 2; begin + kStretch <= seen.size(); begin += kStretch)
    take(begin, kStretch);
  EXPECT_NEAR(model.noise.level(), before, 0.15);
}

// What other axes share of a band is motion: where a level alone is believed it raises none, and makes none less than believed. Where a colour is
// known, the bands themselves tell.
TEST(NoiseLevel, IsNoMoreThanTheAxisHasByItself) {
  const auto level = [](const NoiseModel& believed, double own) {
    NoiseTracker tracker;
    BandPower share{};
    share.fill(own);
    const std::vector<double> power(kNoiseBands * 64 + 1, 1.3);
    for (int i = 0; i < 96; ++i)
      tracker.observe(power, std::vector<double>(power.size(), 1.0), believed, 1.0 / 32.0, 1.0 / 32.0, share);
    return tracker.level();
  };
  const NoiseModel white = white_noise(1.0);
  const double all = level(white, 1.0);
  ASSERT_GT(all, 1.2);
  EXPECT_NEAR(level(white, 0.9), 0.9 * all, 1e-9);
  EXPECT_EQ(level(white, 0.1), 1.0);
  NoiseModel coloured = white_noise(0.9);
  coloured.colour_order = 1;
  coloured.colour[0] = 0.1;
  coloured.colour_variance = 0.1;
  EXPECT_EQ(level(coloured, 0.1), level(coloured, 1.0));
  EXPECT_NEAR(level({}, 0.5), 0.5 * level({}, 1.0), 1e-9);
}

// The mean to the power of 1.5, or that of the quietest three beyond 4 % to the power of 3: the smaller.
TEST(NoiseLevel, IsRaisedAsTheQuietestThreeAllow) {
  EXPECT_NEAR(level_of_bands({1.08, 1.08, 1.08, 1.5, 1.5, 1.5, 1.5, 1.5}), std::pow(1.08 / 1.04, 3.0), 1e-9);
  EXPECT_NEAR(level_of_bands({1.2, 1.2, 1.2, 1.24, 1.24, 1.24, 1.24, 1.24}), std::pow(1.225, 1.5), 1e-9);
}

// A minute at rest knows its noise to some per cent: bands that are louder by less raise nothing, however much a road adds to the others.
TEST(NoiseLevel, IsNotRaisedByWhatAModelIsOffByAnyway) {
  EXPECT_DOUBLE_EQ(level_of_bands({1.03, 1.03, 1.03, 1.8, 1.8, 1.8, 1.8, 1.8}), 1.0);
}

// Below half of what is believed in the quietest four: it is that, whatever the others show. Else what is above it speaks for the belief.
TEST(NoiseLevel, FourBandsBelowHalfAreTheLevel) {
  EXPECT_NEAR(level_of_bands({0.4, 0.4, 0.4, 0.4, 1.9, 1.9, 1.9, 1.9}), 0.4, 1e-9);
  EXPECT_NEAR(level_of_bands({1.9, 0.48, 1.9, 0.48, 1.9, 0.48, 1.9, 0.48}), 0.48, 1e-9);
  EXPECT_DOUBLE_EQ(level_of_bands({0.6, 0.6, 0.6, 0.6, 1.9, 1.9, 1.9, 1.9}), 1.0);
}

// All bands beyond 2: noise where the quietest four are within a quarter of one another, a road where they are not.
TEST(NoiseLevel, FourBandsAlikeAreTheLevelWhereAllAreLouder) {
  EXPECT_NEAR(level_of_bands({10.0, 10.0, 10.0, 12.4, 40.0, 60.0, 90.0, 140.0}), 10.6, 1e-9);
  EXPECT_DOUBLE_EQ(level_of_bands({10.0, 10.0, 10.0, 12.6, 40.0, 60.0, 90.0, 140.0}), 1.0);
  EXPECT_DOUBLE_EQ(level_of_bands({1.39, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0}), 1.0)
      << "one is as quiet as it is believed to be";
}

// All bands beyond 1.4 and one of them below 2: five that are within 1.3 of one another, the quietest left out where it is apart, are noise.
TEST(NoiseLevel, FiveBandsAlikeAreTheLevelWhereAllAreALittleLouder) {
  EXPECT_NEAR(level_of_bands({1.5, 1.5, 1.5, 1.8, 1.94, 3.0, 5.0, 9.0}), 1.575, 1e-9);
  EXPECT_DOUBLE_EQ(level_of_bands({1.5, 1.5, 1.5, 1.8, 2.01, 3.0, 5.0, 9.0}), 1.0);
  EXPECT_NEAR(level_of_bands({1.41, 2.0, 2.0, 2.2, 2.2, 2.5, 5.0, 9.0}), 2.1, 1e-9);
  EXPECT_DOUBLE_EQ(level_of_bands({1.39, 2.1, 2.1, 2.1, 2.1, 2.1, 2.1, 2.1}), 1.0)
      << "one is hardly louder than it is believed to be";
}

// What was found holds for as long as no band is as quiet as believed, however little alike the bands are for a while.
TEST(NoiseLevel, HoldsUntilABandIsAsQuietAsBelieved) {
  BandPower alike{};
  alike.fill(1.8);
  NoiseTracker tracker = after_bands(alike);
  ASSERT_NEAR(tracker.level(), 1.8, 1e-9);
  observe(tracker, {1.5, 1.5, 1.5, 2.1, 2.1, 3.0, 5.0, 9.0}, 400);
  EXPECT_GT(tracker.level(), 1.4);
  observe(tracker, {1.2, 1.5, 1.5, 2.1, 2.1, 3.0, 5.0, 9.0}, 400);
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
}

// Four bands of a road are alike for a moment; and where all shake far more than at their quietest, what is alike there is a road, too. A level that
// is wrong by a factor of 10 must have been there for a window's length, one that nearly all bands show need not.
TEST(NoiseLevel, IsNotThatOfARoadWhichIsAlikeForAMoment) {
  const BandPower four_alike = {10.0, 10.0, 10.0, 12.4, 40.0, 60.0, 90.0, 140.0};
  EXPECT_DOUBLE_EQ(
      [&] {
        NoiseTracker tracker;
        observe(tracker, four_alike, 32 + 24);
        return tracker.level();
      }(),
      1.0);
  EXPECT_NEAR(
      [] {
        NoiseTracker tracker;
        observe(tracker, {5.0, 10.0, 10.0, 11.0, 11.0, 12.0, 12.0, 900.0}, 32);
        return tracker.level();
      }(),
      10.5, 0.01);
  NoiseTracker tracker = after_bands(four_alike);
  ASSERT_NEAR(tracker.level(), 10.6, 1e-9);
  observe(tracker, {90.0, 120.0, 160.0, 210.0, 280.0, 370.0, 490.0, 650.0}, 400);
  EXPECT_DOUBLE_EQ(tracker.level(), 1.0);
}

// Noise is about the same in every window, shaking is not: here the mean of three windows is the same all the time, and half of the bands are alike in it.
TEST(NoiseLevel, IsNotThatOfBandsThatComeAndGo) {
  const auto level_where_they_swing_by = [](double part, const BandPower& mean) {
    NoiseTracker tracker;
    for (int i = 0; i < 160; ++i) {
      BandPower bands = mean;
      for (double& band : bands) band *= i % 8 < 4 ? 1.0 + part : 1.0 - part;
      observe(tracker, bands, 1);
    }
    return tracker.level();
  };
  // The limit of three times 25 / 1024 is a swing of 0.27.
  const BandPower four_alike = {10.0, 10.0, 10.0, 12.4, 40.0, 60.0, 90.0, 140.0};
  EXPECT_NEAR(level_where_they_swing_by(0.2, four_alike), 10.6, 0.3);
  EXPECT_DOUBLE_EQ(level_where_they_swing_by(0.35, four_alike), 1.0);
  const BandPower a_little_louder = {1.3, 1.3, 1.3, 1.3, 1.3, 1.3, 1.3, 1.3};
  EXPECT_NEAR(level_where_they_swing_by(0.2, a_little_louder), std::pow(1.3, 1.5), 0.1);
  EXPECT_DOUBLE_EQ(level_where_they_swing_by(0.35, a_little_louder), 1.0);
}

// A car that stands for two seconds, and drives off: what was there at first bounds what the noise can be.
TEST(NoiseLevel, IsNoMoreThanTheFirstMomentsShow) {
  const auto level_after_a_quarter_of = [](double quiet) {
    NoiseTracker tracker;
    observe(tracker, {quiet, quiet, quiet, quiet, 30.0, 40.0, 50.0, 60.0}, 8);
    observe(tracker, {2.2, 2.2, 2.2, 2.2, 100.0, 150.0, 200.0, 250.0}, 152);
    return tracker.level();
  };
  // The mean of the first quarter counts 1.3 times, and 1.25 times that is the most: 1.79 and 2.44.
  EXPECT_DOUBLE_EQ(level_after_a_quarter_of(1.1), 1.0);
  EXPECT_NEAR(level_after_a_quarter_of(1.5), 2.2, 0.05);
}

// The quietest may be that of a line which is believed to be there and is not: then those next to it.
TEST(NoiseLevel, TheQuietestBandMayBeThatOfALine) {
  EXPECT_NEAR(level_of_bands({40.0, 10.0, 10.0, 5.0, 10.0, 10.0, 60.0, 90.0}), 10.0, 1e-9);
  EXPECT_DOUBLE_EQ(level_of_bands({40.0, 10.0, 10.0, 5.0, 10.0, 13.0, 60.0, 90.0}), 1.0);
  // However far apart it is: it says nothing of what the others have been.
  EXPECT_NEAR(level_of_bands({80.0, 20.0, 20.0, 2.1, 20.0, 20.0, 120.0, 180.0}), 20.0, 1e-9);
  EXPECT_NEAR(level_of_bands({1.9, 0.4, 0.4, 0.001, 0.4, 0.4, 1.9, 1.9}), 0.4, 1e-9);
}

TEST(NoiseLevel, IsSaidToBeWrongBelowFourFifths) {
  const auto disagrees_at = [](double level) {
    BandPower bands{};
    bands.fill(level);
    return after_bands(bands).disagrees();
  };
  EXPECT_TRUE(disagrees_at(0.79));
  EXPECT_FALSE(disagrees_at(0.81));
  EXPECT_FALSE(disagrees_at(std::pow(1.39, 1.0 / 1.5)));
  EXPECT_TRUE(disagrees_at(std::pow(1.41, 1.0 / 1.5)));
}

}  // namespace
}  // namespace gyrod::core
