#include "core/noise/standstill_learner.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "core/noise/still_noise.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;
using testing::kRadPerDeg;

double level_dps(const NoiseModel& model) { return std::sqrt(noise_variance(model)) / kRadPerDeg; }

/// Steps through it. @return seconds at rest
double seconds_at_rest(StandstillLearner& learner, const Axes& axes) {
  double seconds = 0.0;
  testing::run(learner, axes, [&] { seconds += learner.at_rest() ? 0.01 : 0.0; });
  return seconds;
}

void rest(StandstillLearner& learner, double seconds, double noise_dps, unsigned seed) {
  seconds_at_rest(learner, testing::still_axes(static_cast<std::size_t>(100.0 * seconds), noise_dps, seed));
}

TEST(StandstillLearner, LearnsInAMinuteWhatAWholeStillRecordTells) {
  const Axes axes = testing::still_axes(6000, 0.35, 2);
  StandstillLearner learner(100.0);
  testing::run(learner, axes, [] {});
  EXPECT_GT(learner.rest_seconds(), 50.0);
  for (std::size_t a = 0; a < 3; ++a) {
    const auto whole = still_noise(axes[a]);
    ASSERT_TRUE(whole.has_value());
    // Nine tenths of the same samples; the level's own standard error is 0.9 %.
    EXPECT_NEAR(level_dps(learner.models()[a]), level_dps(*whole), 0.01 * level_dps(*whole));
    EXPECT_NEAR(level_dps(learner.models()[a]), 0.35, 4.0 * 0.01 * 0.35);
  }
  EXPECT_NEAR(learner.bias()[2], 1.0 * kRadPerDeg, 4.0 * 0.35 * kRadPerDeg / std::sqrt(6000.0));
}

TEST(StandstillLearner, HasALevelAfterTwentySeconds) {
  StandstillLearner learner(100.0);
  EXPECT_FALSE(is_usable(learner.models()[0]));
  EXPECT_EQ(learner.revision(), 0U);
  rest(learner, 20.0, 0.35, 4);
  EXPECT_GT(learner.revision(), 0U);
  for (const NoiseModel& model : learner.models()) EXPECT_NEAR(level_dps(model), 0.35, 0.35 * 4.0 * 0.02);
}

TEST(StandstillLearner, AddsUpShortRests) {
  // Ten stops of 15 s between drives of 20 s.
  StandstillLearner learner(100.0);
  for (unsigned stop = 0; stop < 10; ++stop) {
    rest(learner, 15.0, 0.35, 10 + stop);
    Axes drive = testing::still_axes(2000, 0.6, 50 + stop);
    testing::add_tone(drive, 2, 8.0, 0.001);
    EXPECT_LE(seconds_at_rest(learner, drive), 1.0) << "until the first block ends";
  }
  EXPECT_GT(learner.rest_seconds(), 60.0);
  for (const NoiseModel& model : learner.models()) EXPECT_NEAR(level_dps(model), 0.35, 0.35 * 4.0 * 0.009);
}

TEST(StandstillLearner, IsNotFooledByASlowConstantTurn) {
  StandstillLearner learner(100.0);
  rest(learner, 60.0, 0.35, 5);
  const Triple bias = learner.bias();
  const double learned = learner.rest_seconds();
  Axes turn = testing::still_axes(2000, 0.35, 6);
  testing::add_rate(turn, 2, 2.0);
  EXPECT_LE(seconds_at_rest(learner, turn), 1.0);
  EXPECT_EQ(learner.bias(), bias);
  EXPECT_EQ(learner.rest_seconds(), learned);
}

// A smooth engine that passes for rest under a loud sensor (WID trial 06 in three times an ADIS16405's noise: 0.46 and 0.30 deg/s at 22.5 Hz, a quarter turn
// apart): the car stands, and what the engine shakes is no noise of the sensor's.
TEST(StandstillLearner, DoesNotLearnWhatAnEngineShakes) {
  StandstillLearner learner(100.0);
  Axes idle = testing::still_axes(6000, 1.0, 5);
  testing::add_tone(idle, 0, 0.46 * std::numbers::sqrt2, 0.225);
  idle[1] = testing::sum(std::move(idle[1]), testing::tone(6000, 0.225, 1.6),
                         0.30 * std::numbers::sqrt2 * kRadPerDeg);
  EXPECT_GT(seconds_at_rest(learner, idle), 45.0);
  for (const NoiseModel& model : learner.models()) {
    EXPECT_EQ(model.line_count, 0U);
    EXPECT_NEAR(level_dps(model), 1.0, 4.0 * 0.01);
  }
  EXPECT_NEAR(learner.bias()[2], 1.0 * kRadPerDeg, 4.0 * kRadPerDeg / std::sqrt(6000.0));
}

TEST(StandstillLearner, LearnsALineOfTheSensorsOwn) {
  StandstillLearner learner(100.0);
  Axes still = testing::still_axes(6000, 0.35, 5);
  testing::add_tone(still, 2, 0.25, 0.197);
  testing::run(learner, still, [] {});
  EXPECT_EQ(learner.models()[0].line_count, 0U);
  ASSERT_EQ(learner.models()[2].line_count, 1U);
  EXPECT_NEAR(learner.models()[2].line[0].cycles, 0.197, 0.1 / kNoiseSegment);
}

TEST(StandstillLearner, OutvotesATurnThatItTookForTheFirstRest) {
  StandstillLearner learner(100.0);
  Axes turn = testing::still_axes(2000, 0.35, 7);
  testing::add_rate(turn, 2, 3.0);
  testing::run(learner, turn, [] {});
  EXPECT_NEAR(learner.bias()[2], 4.0 * kRadPerDeg, 0.1 * kRadPerDeg);
  for (unsigned stop = 0; stop < 3; ++stop) {
    rest(learner, 20.0, 0.35, 20 + stop);
    learner.interrupt();
  }
  EXPECT_TRUE(learner.bias()[2] < 1.1 * kRadPerDeg);
  // The turn did not change the noise.
  EXPECT_NEAR(level_dps(learner.models()[2]), 0.35, 0.35 * 4.0 * 0.012);
}

TEST(StandstillLearner, DoesNotTakeALouderRestForRest) {
  StandstillLearner learner(100.0);
  rest(learner, 60.0, 0.2, 8);
  // A smooth engine: broad vibration that makes the level half as high again.
  // The mean of eight blocks is 1.5 times the learned variance when four of them are louder.
  EXPECT_LE(seconds_at_rest(learner, testing::still_axes(6000, 0.3, 9)), 4.0);
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.2, 0.2 * 4.0 * 0.01);
}

TEST(StandstillLearner, BeginsAnewWhenItGetsQuieter) {
  StandstillLearner learner(100.0);
  rest(learner, 120.0, 0.3, 10);
  const auto before = learner.revision();
  rest(learner, 60.0, 0.2, 11);
  EXPECT_GT(learner.revision(), before);
  EXPECT_LT(learner.rest_seconds(), 60.0);
  for (const NoiseModel& model : learner.models()) EXPECT_NEAR(level_dps(model), 0.2, 0.2 * 4.0 * 0.01);
}

// A frozen axis is quieter than any noise; what was learned is not forgotten for it, nor the axis's own noise averaged with nothing.
TEST(StandstillLearner, ForgetsNothingWhileAnAxisIsStuck) {
  StandstillLearner learner(100.0);
  rest(learner, 120.0, 0.35, 10);
  const double learned = learner.rest_seconds();
  Axes stuck = testing::still_axes(4000, 0.35, 11);
  stuck[0].assign(4000, 0.1);
  EXPECT_LE(seconds_at_rest(learner, stuck), 1.0) << "until the first block ends";
  EXPECT_EQ(learner.rest_seconds(), learned);
  rest(learner, 60.0, 0.35, 12);
  EXPECT_GT(learner.rest_seconds(), learned + 45.0) << "and goes on";
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.35, 0.35 * 4.0 * 0.007);
}

TEST(StandstillLearner, AnAxisThatComesToLifeHasItsFullLevelAtOnce) {
  StandstillLearner learner(100.0);
  Axes dead = testing::still_axes(6000, 0.35, 13);
  dead[0].assign(6000, 0.3 * kRadPerDeg);
  testing::run(learner, dead, [] {});
  EXPECT_FALSE(is_usable(learner.models()[0]));
  rest(learner, 60.0, 0.35, 14);
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.35, 0.35 * 4.0 * 0.01);
  EXPECT_GT(learner.rest_seconds(), 100.0);
}

// White noise has no lines. Its first segments are few, whatever the other axes have seen: weighed as if they were many, they look like three.
TEST(StandstillLearner, AnAxisThatComesToLifeBeginsWithItsOwnSegments) {
  for (unsigned seed = 20; seed < 24; ++seed) {
    StandstillLearner learner(100.0);
    Axes dead = testing::still_axes(30'000, 0.35, seed);
    dead[0].assign(30'000, 0.0);
    testing::run(learner, dead, [] {});
    testing::run(learner, testing::still_axes(2000, 0.35, seed + 10), [&] {
      for (const NoiseModel& model : learner.models()) ASSERT_EQ(model.line_count, 0U) << seed;
    });
    EXPECT_TRUE(is_usable(learner.models()[0])) << "twenty seconds tell a level";
  }
}

// What a dead axis says is no mean rate: the sensor is not turning where the axis then has an offset.
TEST(StandstillLearner, AnAxisThatComesToLifeWithAnOffsetIsAtRest) {
  StandstillLearner learner(100.0);
  Axes dead = testing::still_axes(30'000, 0.35, 15);
  dead[0].assign(30'000, 0.0);
  testing::run(learner, dead, [] {});
  Axes alive = testing::still_axes(2000, 0.35, 16);
  testing::add_rate(alive, 0, 2.0);
  EXPECT_GT(seconds_at_rest(learner, alive), 10.0) << "eight blocks after it comes to life";
  EXPECT_NEAR(learner.bias()[0], 2.3 * kRadPerDeg, 0.1 * kRadPerDeg);
  testing::add_rate(alive, 0, 2.0);
  EXPECT_LE(seconds_at_rest(learner, alive), 1.0) << "and from then on it has a say";
}

TEST(StandstillLearner, BelievesAHigherLevelAfterHalfAnHour) {
  StandstillLearner learner(100.0);
  rest(learner, 60.0, 0.2, 12);
  rest(learner, 1700.0, 0.4, 13);
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.2, 0.01);
  rest(learner, 200.0, 0.4, 14);
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.4, 0.4 * 4.0 * 0.009);
}

TEST(StandstillLearner, FollowsASlowDrift) {
  // A fifth more, and an hour at rest: six times its memory.
  StandstillLearner learner(100.0);
  rest(learner, 600.0, 0.30, 15);
  rest(learner, 3600.0, 0.36, 16);
  EXPECT_NEAR(level_dps(learner.models()[1]), 0.36, 0.36 * 4.0 * 0.003);
}

// A sensor on a link that loses one in seventy, bridged by straight lines.
TEST(StandstillLearner, LearnsFromASensorThatLosesASampleNowAndThen) {
  const Axes axes = testing::still_axes(6000, 0.35, 18);
  StandstillLearner learner(100.0);
  for (std::size_t n = 1; n + 1 < 6000; ++n) {
    const bool lost = n % 70 == 0;
    Triple rate{};
    for (std::size_t a = 0; a < 3; ++a) rate[a] = lost ? 0.5 * (axes[a][n - 1] + axes[a][n + 1]) : axes[a][n];
    learner.step(rate, nullptr, !lost);
  }
  EXPECT_TRUE(learner.at_rest());
  EXPECT_GT(learner.rest_seconds(), 50.0);
  EXPECT_NEAR(level_dps(learner.models()[0]), 0.35, 0.35 * 4.0 * 0.01);
}

TEST(StandstillLearner, RestEndsWithALongGap) {
  StandstillLearner learner(100.0);
  rest(learner, 60.0, 0.35, 19);
  EXPECT_TRUE(learner.at_rest());
  for (int n = 0; n < 16; ++n) learner.step({}, nullptr, false);
  EXPECT_FALSE(learner.at_rest());
}

TEST(StandstillLearner, GivesTheSameBitsForTheSameSamples) {
  StandstillLearner one(100.0);
  StandstillLearner two(100.0);
  rest(one, 100.0, 0.35, 17);
  rest(two, 100.0, 0.35, 17);
  EXPECT_EQ(one.state(), two.state());
  EXPECT_EQ(one.revision(), two.revision());
}

TEST(StandstillLearner, GoesOnFromItsState) {
  StandstillLearner before(100.0);
  rest(before, 120.0, 0.35, 18);
  StandstillLearner after(100.0);
  ASSERT_TRUE(after.restore(before.state()));
  EXPECT_EQ(after.models(), before.models());
  EXPECT_EQ(after.bias(), before.bias());
  EXPECT_EQ(after.revision(), 1U);
  rest(after, 60.0, 0.35, 19);
  EXPECT_GT(after.rest_seconds(), before.rest_seconds() + 50.0);
  // Three minutes in all, of which one went through the model.
  for (const NoiseModel& model : after.models()) EXPECT_NEAR(level_dps(model), 0.35, 0.35 * 4.0 * 0.006);
  EXPECT_LE(seconds_at_rest(after, testing::still_axes(6000, 0.7, 20)), 1.0) << "it knows the level";
}

TEST(StandstillLearner, RefusesAStateThatCannotBe) {
  StandstillLearner source(100.0);
  rest(source, 60.0, 0.35, 21);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::array<StandstillState, 6> bad;
  bad.fill(source.state());
  bad[0].sample_rate_hz = 200.0;
  bad[1].models[1].white_variance = nan;
  bad[2].bias[0] = std::numeric_limits<double>::infinity();
  bad[3].segments = -1.0;
  bad[4].models = {};
  bad[5].models[2].colour[0] = 3.0;
  for (const StandstillState& state : bad) {
    StandstillLearner learner(100.0);
    EXPECT_FALSE(learner.restore(state));
    EXPECT_EQ(learner.revision(), 0U);
    EXPECT_FALSE(is_usable(learner.models()[0]));
  }
}

TEST(StandstillLearner, BeginsAnewWithAnotherSampleRate) {
  StandstillLearner learner(1000.0);
  rest(learner, 100.0, 0.7, 23);
  learner.retime(100.0);
  EXPECT_FALSE(is_usable(learner.models()[0]));
  rest(learner, 60.0, 0.35, 24);
  StandstillLearner fresh(100.0);
  rest(fresh, 60.0, 0.35, 24);
  EXPECT_EQ(learner.state(), fresh.state());
}

TEST(StandstillLearner, LearnsTheAxesThatAreThere) {
  Axes axes = testing::still_axes(6000, 0.35, 22);
  axes[2].assign(6000, 0.0);
  StandstillLearner learner(100.0);
  testing::run(learner, axes, [] {});
  EXPECT_TRUE(is_usable(learner.models()[0]));
  EXPECT_FALSE(is_usable(learner.models()[2]));
  StandstillLearner after(100.0);
  EXPECT_TRUE(after.restore(learner.state()));
}

}  // namespace
}  // namespace gyrod::core
