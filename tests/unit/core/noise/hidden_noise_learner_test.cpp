#include "core/noise/hidden_noise_learner.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "core/evaluation/butterworth.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;

constexpr double kRateHz = 1000.0;
constexpr std::size_t kMinute = 60'000;
/// Deviation of the noise before the low-pass, deg/s.
constexpr double kLevel = 0.3;
/// The sensor's own low-pass, cycles per sample: 98 Hz.
constexpr double kCutoff = 0.098;

/// What the filter leaves of white noise of variance 1 at a frequency in cycles per sample: |H|^2.
double passed(double frequency, double cutoff = kCutoff, std::size_t order = 2) {
  const double ratio = std::tan(std::numbers::pi * frequency) / std::tan(std::numbers::pi * cutoff);
  return 1.0 / (1.0 + std::pow(ratio, 2.0 * static_cast<double>(order)));
}

/// Its mean over all frequencies: what is left of the variance.
double left_over(double cutoff = kCutoff, std::size_t order = 2) {
  constexpr std::size_t kSteps = 10'000;
  double sum = 0.0;
  for (std::size_t k = 0; k < kSteps; ++k)
    sum += passed(0.5 * (static_cast<double>(k) + 0.5) / kSteps, cutoff, order);
  return sum / kSteps;
}

void low_pass(Axes& axes, double cutoff = kCutoff, std::size_t order = 2) {
  for (auto& axis : axes) filter_forward(butterworth(order, cutoff), axis);
}

/// A car: on each axis turns below 1 Hz, and a road about 15 Hz, far above the noise there; z has ten times less of the road.
Axes with_motion(Axes axes, double scale = 1.0) {
  constexpr std::array<double, 2> kRoad = {2.0 * 0.95 * 0.9956, -0.95 * 0.95};  // 0.015 cycles per sample
  for (unsigned a = 0; a < 3; ++a) {
    const std::size_t size = axes[a].size();
    const double road = scale * (a == 2 ? 0.003 : 0.03) * testing::kRadPerDeg;
    axes[a] = testing::sum(std::move(axes[a]), testing::autoregressive(kRoad, size, 70 + a), road);
    axes[a] = testing::sum(std::move(axes[a]), testing::tone(size, 2e-4 + 1e-4 * static_cast<double>(a)),
                           10.0 * scale * testing::kRadPerDeg);
  }
  return axes;
}

/// Noise and motion of a car, both through the sensor's low-pass.
Axes driven(std::size_t size, unsigned seed, double level = kLevel) {
  Axes axes = with_motion(testing::still_axes(size, level, seed));
  low_pass(axes);
  return axes;
}

bool knows(const HiddenNoiseLearner& learner) {
  return is_usable(learner.models()[0]) && is_usable(learner.models()[1]) && is_usable(learner.models()[2]);
}

bool learns(const Axes& axes, double rate_hz = kRateHz) {
  HiddenNoiseLearner learner(rate_hz);
  bool known = false;
  testing::run(learner, axes, [&] { known = known || knows(learner); });
  return known;
}

double variance(const HiddenNoiseLearner& learner, std::size_t axis = 0) {
  return noise_variance(learner.models()[axis]) / std::pow(testing::kRadPerDeg, 2.0);
}

TEST(HiddenNoiseLearner, LearnsLevelAndColourBehindALowPassInMotion) {
  HiddenNoiseLearner learner(kRateHz);
  Axes axes = testing::still_axes(kMinute, kLevel, 3);
  for (double& value : axes[1]) value *= 1.3;
  axes = with_motion(std::move(axes));
  low_pass(axes);
  testing::run(learner, axes, [] {});
  ASSERT_TRUE(knows(learner));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double level = axis == 1 ? 1.3 * kLevel : kLevel;
    // Where motion is, it is taken to be a little less: the flat part found is on the filter's shoulder.
    EXPECT_NEAR(variance(learner, axis) / (level * level * left_over()), 0.95, 0.1) << axis;
    for (const double frequency : {0.06, 0.08, 0.1, 0.15}) {
      const double density = noise_spectrum(learner.models()[axis], 2.0 * std::numbers::pi * frequency) /
                             std::pow(level * testing::kRadPerDeg, 2.0);
      // AR(8) rounds the filter's shoulder.
      EXPECT_NEAR(density / passed(frequency), 1.0, 0.3) << axis << " at " << frequency;
    }
  }
}

// 60 Hz, 2 Hz to either side, on z alone.
TEST(HiddenNoiseLearner, AddsTheLineOfAnAxisToWhatTheLowPassLeaves) {
  HiddenNoiseLearner learner(kRateHz);
  Axes axes = driven(2 * kMinute, 3);
  const std::array<double, 2> line = {2.0 * 0.9875 * std::cos(0.12 * std::numbers::pi), -0.9875 * 0.9875};
  axes[2] = testing::sum(std::move(axes[2]), testing::autoregressive(line, 2 * kMinute, 90),
                         0.006 * testing::kRadPerDeg);
  testing::run(learner, axes, [] {});
  ASSERT_TRUE(knows(learner));
  EXPECT_EQ(learner.models()[0].line_count, 0U);
  ASSERT_EQ(learner.models()[2].line_count, 1U);
  EXPECT_NEAR(learner.models()[2].line[0].cycles, 0.06, 0.002);
}

TEST(HiddenNoiseLearner, LearnsWhatIsThereAtRest) {
  HiddenNoiseLearner learner(kRateHz);
  Axes axes = testing::still_axes(kMinute, kLevel, 3);
  low_pass(axes, 0.05, 4);
  testing::run(learner, axes, [] {});
  ASSERT_TRUE(knows(learner));
  EXPECT_NEAR(variance(learner) / (kLevel * kLevel * left_over(0.05, 4)), 1.0, 0.05);
}

// Four halves of 4.1 s; the fourth is known to be noise when it ends.
TEST(HiddenNoiseLearner, TakesSixteenSeconds) {
  HiddenNoiseLearner learner(kRateHz);
  std::size_t samples = 0;
  testing::run(learner, driven(kMinute, 5), [&] { samples += knows(learner) ? 0U : 1U; });
  EXPECT_GE(samples, 16'000U);
  EXPECT_LE(samples, 17'000U);
}

TEST(HiddenNoiseLearner, SaysNothingWhereNoiseHasAFloor) {
  EXPECT_FALSE(learns(testing::still_axes(kMinute, kLevel, 3)));
  EXPECT_FALSE(learns(with_motion(testing::still_axes(kMinute, kLevel, 3))));
  // A tenth of the deviation is white: of its density, a hundredth, the last band has more than a tenth of nothing else.
  Axes coarse = driven(kMinute, 3);
  const Axes white = testing::still_axes(kMinute, 0.15, 4);
  for (std::size_t a = 0; a < 3; ++a) coarse[a] = testing::sum(std::move(coarse[a]), white[a]);
  EXPECT_FALSE(learns(coarse));
}

// Red on each axis, as hands and roads are: no part of it is flat.
TEST(HiddenNoiseLearner, DoesNotTakeMotionForNoise) {
  Axes axes = testing::still_axes(kMinute, 1e-4, 3);
  for (unsigned a = 0; a < 3; ++a) {
    const std::array<double, 2> red = {2.0 * 0.98, -0.98 * 0.98};
    axes[a] = testing::sum(std::move(axes[a]), testing::autoregressive(red, kMinute, 40 + a),
                           1e-3 * testing::kRadPerDeg);
  }
  low_pass(axes);
  EXPECT_FALSE(learns(axes));
}

// A rattle about a slanted axis looks like noise, but all axes have the same.
TEST(HiddenNoiseLearner, DoesNotTakeWhatAxesShareForNoise) {
  Axes axes = testing::still_axes(kMinute, 0.1 * kLevel, 3);
  const Axes rattle = testing::still_axes(kMinute, kLevel, 9);
  for (std::size_t a = 0; a < 3; ++a)
    axes[a] = testing::sum(std::move(axes[a]), rattle[0], a == 0 ? -1.0 : 1.0);
  low_pass(axes);
  EXPECT_FALSE(learns(axes));
}

TEST(HiddenNoiseLearner, DoesNotTakeForNoiseWhatOneAxisHasFarMoreOf) {
  Axes axes = testing::still_axes(kMinute, kLevel, 3);
  for (double& value : axes[1]) value *= 2.0;
  low_pass(axes);
  EXPECT_FALSE(learns(axes)) << "four times the variance";
}

TEST(HiddenNoiseLearner, DoesNotTakeForNoiseWhatComesAndGoes) {
  Axes axes = testing::still_axes(kMinute, kLevel, 3);
  for (auto& axis : axes) {
    for (std::size_t n = 0; n < axis.size(); ++n) axis[n] *= (n / 4096) % 2 == 0 ? 1.0 : 2.0;
  }
  low_pass(axes);
  EXPECT_FALSE(learns(axes));
}

TEST(HiddenNoiseLearner, TheQuietestWins) {
  HiddenNoiseLearner learner(kRateHz);
  testing::run(learner, driven(kMinute, 5, 2.0 * kLevel), [] {});
  ASSERT_TRUE(knows(learner));
  const double loud = variance(learner);
  testing::run(learner, driven(kMinute, 6), [] {});
  const double quiet = variance(learner);
  EXPECT_NEAR(loud / quiet, 4.0, 0.4);
  const auto revision = learner.revision();
  testing::run(learner, driven(kMinute, 7, 2.0 * kLevel), [] {});
  EXPECT_EQ(learner.revision(), revision) << "a louder minute, of a rattle";
}

// At 100 samples a second. What was quietest is forgotten within 20 minutes; then it takes half an hour.
TEST(HiddenNoiseLearner, WhatStaysLouderForLongIsBelieved) {
  constexpr std::size_t kSlowMinute = 6000;
  HiddenNoiseLearner learner(100.0);
  const auto pass = [&learner](std::size_t minutes, double level, unsigned seed) {
    Axes axes = testing::still_axes(minutes * kSlowMinute, level, seed);
    low_pass(axes);
    testing::run(learner, axes, [] {});
    return variance(learner) / (kLevel * kLevel * left_over());
  };
  EXPECT_NEAR(pass(5, kLevel, 1), 0.95, 0.1);
  EXPECT_NEAR(pass(25, 2.0 * kLevel, 2), 0.95, 0.1);
  EXPECT_NEAR(pass(60, 2.0 * kLevel, 3), 4.0, 0.4);
}

TEST(HiddenNoiseLearner, AGapIsBridgedByNothing) {
  const Axes axes = driven(kMinute, 5);
  HiddenNoiseLearner learner(kRateHz);
  for (std::size_t n = 0; n < kMinute; ++n) {
    if (n % 8000 == 0) learner.interrupt();  // two halves of 4096 samples and the first segment need more
    learner.step({axes[0][n], axes[1][n], axes[2][n]});
  }
  EXPECT_FALSE(knows(learner));
}

TEST(HiddenNoiseLearner, SegmentsWithManySamplesThatNobodyMeasuredTellNothing) {
  const Axes axes = driven(kMinute, 5);
  HiddenNoiseLearner learner(kRateHz);
  for (std::size_t n = 0; n < kMinute; ++n) learner.step({axes[0][n], axes[1][n], axes[2][n]}, n % 40 != 0);
  EXPECT_EQ(learner.revision(), 0U);
  for (std::size_t n = 0; n < kMinute; ++n) learner.step({axes[0][n], axes[1][n], axes[2][n]}, n % 60 != 0);
  EXPECT_TRUE(knows(learner));
}

// Its power would be the least ever seen.
TEST(HiddenNoiseLearner, AnAxisThatHangsForAWhileChangesNothing) {
  Axes axes = driven(2 * kMinute, 5);
  for (std::size_t n = 5000; n < 15'000; ++n) axes[1][n] = axes[1][5000];
  HiddenNoiseLearner learner(kRateHz);
  testing::run(learner, axes, [] {});
  ASSERT_TRUE(knows(learner));
  EXPECT_NEAR(variance(learner, 1) / (kLevel * kLevel * left_over()), 0.95, 0.1);
}

TEST(HiddenNoiseLearner, AnAxisThatIsDeadLeavesNothingToCompare) {
  Axes axes = driven(kMinute, 5);
  axes[2].assign(kMinute, 0.25);
  EXPECT_FALSE(learns(axes));
}

TEST(HiddenNoiseLearner, ForgetsAllAtAnotherRate) {
  HiddenNoiseLearner learner(kRateHz);
  testing::run(learner, driven(kMinute, 5), [] {});
  ASSERT_TRUE(knows(learner));
  const auto revision = learner.revision();
  learner.retime(200.0);
  EXPECT_FALSE(knows(learner));
  EXPECT_GT(learner.revision(), revision);
  HiddenNoiseLearner fresh(200.0);
  const Axes axes = driven(kMinute, 8);
  testing::run(learner, axes, [] {});
  testing::run(fresh, axes, [] {});
  EXPECT_EQ(learner.models(), fresh.models());
}

TEST(HiddenNoiseLearner, StaysFiniteAndSilentForAnyFiniteInput) {
  for (const double scale : {1e-300, 1e-150, 1e150, 1e300}) {
    Axes axes = driven(kMinute, 5);
    for (auto& axis : axes) {
      for (double& value : axis) value *= scale;
    }
    HiddenNoiseLearner learner(kRateHz);
    testing::run(learner, axes, [] {});
    for (const NoiseModel& model : learner.models())
      EXPECT_TRUE(model == NoiseModel{} || is_usable(model)) << scale;
  }
}

}  // namespace
}  // namespace gyrod::core
