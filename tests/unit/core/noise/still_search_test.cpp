#include "core/noise/still_search.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/noise/still_noise.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;

StillInput input_of(const Axes& axes) { return {.rate = {axes[0], axes[1], axes[2]}, .accelerometer = {}}; }

void append(Axes& axes, const Axes& more) {
  for (std::size_t a = 0; a < 3; ++a) axes[a].insert(axes[a].end(), more[a].begin(), more[a].end());
}

Axes moving(std::size_t size, unsigned seed) {
  Axes axes = testing::still_axes(size, 0.8, seed);
  testing::add_tone(axes, 2, 9.0, 0.0013);
  return axes;
}

/// At rest, moving for 2000 samples or so many, and at rest again.
Axes moved_between(std::size_t before, std::size_t after, double std_before, double std_after,
                   std::size_t moved = 2000) {
  Axes axes = testing::still_axes(before, std_before, 1);
  append(axes, moving(moved, 2));
  append(axes, testing::still_axes(after, std_after, 3));
  return axes;
}

TEST(StillSearch, FindsAWholeStillRecording) {
  const Axes axes = testing::still_axes(6050, 0.35, 1);
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 1U);
  EXPECT_EQ(found.stretches[0].first, 0U);
  EXPECT_EQ(found.stretches[0].size, 6000U) << "the last half block is not judged";
  EXPECT_EQ(found.still, 6000U);
}

TEST(StillSearch, FindsTheStretchesBetweenTheMotion) {
  const Axes axes = moved_between(3000, 4000, 0.35, 0.35, 3000);
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 2U);
  EXPECT_EQ(found.stretches[0].first, 0U);
  EXPECT_EQ(found.stretches[0].size, 3000U);
  EXPECT_GE(found.stretches[1].first, 6000U);
  EXPECT_LE(found.stretches[1].first, 6100U);
  EXPECT_GT(found.verdicts[static_cast<std::size_t>(RestVerdict::kUneven)], 2000U);
}

TEST(StillSearch, LeavesOutWhatIsLouderThanTheQuietest) {
  Axes axes = testing::still_axes(3000, 0.6, 1);
  append(axes, testing::still_axes(3000, 0.2, 2));
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 1U);
  EXPECT_GE(found.stretches[0].first, 3000U);
  EXPECT_GE(found.louder, 2900U);
}

// Up to 1.5 times the variance is one noise; a mean over half a minute knows its own to 3 %.
TEST(StillSearch, KeepsWhatIsLittleLouderThanTheQuietest) {
  for (const double ratio : {1.35, 1.65}) {
    const Axes axes = moved_between(3000, 3000, 0.3, 0.3 * std::sqrt(ratio));
    const StillSearch found = find_still(input_of(axes), 100.0);
    EXPECT_EQ(found.stretches.size(), ratio < 1.5 ? 2U : 1U) << ratio;
    EXPECT_EQ(found.louder > 0, ratio > 1.5) << ratio;
  }
}

// Of one window or of twenty, one noise has one variance.
TEST(StillSearch, KeepsLongStretchesBesideAShortOne) {
  const Axes axes = moved_between(850, 3000, 0.3, 0.3);
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 2U);
  EXPECT_EQ(found.stretches[0].size, 800U);
  EXPECT_EQ(found.louder, 0U);
}

// An axis that is stuck for three quarters of a minute is no rest, and not the quietest one.
TEST(StillSearch, LeavesOutWhereAnAxisIsStuckThatIsAliveElsewhere) {
  Axes axes = testing::still_axes(12000, 0.35, 1);
  std::fill(axes[0].begin() + 4000, axes[0].begin() + 8500, 0.1);
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 2U);
  EXPECT_EQ(found.stretches[0].first, 0U);
  EXPECT_EQ(found.stretches[0].size, 4000U);
  // The first window of a run has too few segments for a verdict on tones.
  EXPECT_EQ(found.stretches[1].first, 8600U);
  EXPECT_EQ(found.stretches[1].size, 3400U);
  EXPECT_EQ(found.stuck, 4400U);
  EXPECT_EQ(found.louder, 0U);
}

TEST(StillSearch, TakesARecordingWhoseAxisNeverChanges) {
  Axes axes = testing::still_axes(6000, 0.35, 1);
  axes[1].assign(6000, 0.1);
  const StillSearch found = find_still(input_of(axes), 100.0);
  EXPECT_EQ(found.still, 6000U);
  EXPECT_EQ(found.stuck, 0U);
}

TEST(StillSearch, LeavesOutASlowConstantTurn) {
  Axes axes = testing::still_axes(4000, 0.35, 1);
  Axes turn = testing::still_axes(5000, 0.35, 2);
  testing::add_rate(turn, 2, 5.0);
  append(axes, turn);
  append(axes, testing::still_axes(4000, 0.35, 3));
  const StillSearch found = find_still(input_of(axes), 100.0);
  ASSERT_EQ(found.stretches.size(), 2U);
  EXPECT_EQ(found.stretches[0].first, 0U);
  EXPECT_EQ(found.stretches[0].size, 4000U);
  EXPECT_GE(found.stretches[1].first, 9000U);
  EXPECT_LE(found.stretches[1].first, 9100U);
  EXPECT_GE(found.turning, 4800U);
}

TEST(StillSearch, FindsNothingInMotionNorInTooLittle) {
  EXPECT_TRUE(find_still(input_of(moving(6000, 4)), 100.0).stretches.empty());
  EXPECT_TRUE(find_still(input_of(testing::still_axes(799, 0.35, 5)), 100.0).stretches.empty());
  EXPECT_TRUE(find_still(input_of(Axes()), 100.0).stretches.empty());
}

TEST(StillSearch, StopsWhenTold) {
  const Axes axes = testing::still_axes(200'000, 0.35, 1);
  int calls = 0;
  const auto found = find_still(input_of(axes), 100.0, [&](double) { return ++calls < 2; });
  EXPECT_EQ(calls, 2);
  EXPECT_LT(found.still, 70'000U);
}

TEST(StillNoise, OfSeveralStretchesSpansNoGap) {
  // Two records on different biases: a segment across the step would hold a jump of 100 times the noise.
  const testing::Signal one = testing::white_noise(1500, 1);
  testing::Signal two = testing::white_noise(1500, 2);
  for (double& value : two) value += 100.0;
  const std::array<std::span<const double>, 2> stretches = {one, two};
  const auto model = still_noise(stretches);
  ASSERT_TRUE(model.has_value());
  EXPECT_NEAR(noise_variance(*model), 1.0, 4.0 * 2.0 * 0.014) << "the standard error of 2600 samples";
}

}  // namespace
}  // namespace gyrod::core
