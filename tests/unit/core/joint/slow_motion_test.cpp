// Whether anything slow moves, by the samples alone.
#include "core/joint/slow_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::JointOptions;
using core::JointScale;
using core::SlowMotion;
using testing::Signal;

constexpr double kMostRatio = 50.0;
/// 20 s at the design's rate.
constexpr int kForgotten = 2400;

double strength_after(SlowMotion& motion, const Signal& samples, double noise_variance = 1.0) {
  double strength = SlowMotion::kUntold;
  for (const double sample : samples) strength = motion.follow(sample, noise_variance, {}, {});
  return strength;
}

/// Two minutes.
constexpr std::size_t kRest = 14400;

/// One that has seen nothing for that long.
SlowMotion at_rest() {
  SlowMotion motion;
  static_cast<void>(strength_after(motion, Signal(kRest, 0.3)));
  return motion;
}

/// Variance of d in white noise of variance 1.
double of_noise(const JointOptions& options) {
  const double a = options.correction_rate;
  const double b = 1.0 / options.motion_mean;
  return (a - b) * (a - b) / (2.0 * (a + b));
}

// At rest and without noise m is 50 (1 - 1/M)^n.
TEST(SlowMotion, BeginsAsIfAllMovedAndForgetsThat) {
  const JointOptions options;
  SlowMotion motion;
  for (int n = 1; n <= kForgotten; ++n) {
    const double m = kMostRatio * std::pow(1.0 - 1.0 / options.motion_memory, n);
    ASSERT_NEAR(motion.follow(0.3, 1.0, options, {}), m, 1e-9) << n;
  }
  EXPECT_LT(motion.follow(0.3, 1.0, options, {}), options.motion_low);
}

/// Of a step of the rate n samples ago, 1 in size.
double after_step(int n, const JointOptions& options) {
  if (n <= 0) return 0.0;
  return std::pow(1.0 - 1.0 / options.motion_mean, n) - std::pow(1.0 - options.correction_rate, n);
}

// A turn of five seconds, one and a half times as large as the noise: half a second after it has begun it is motion, and when it is over it is forgotten within
// 20 s of where d is small again. m is 50 at the most.
TEST(SlowMotion, SeesATurnAtOnceAndForgetsIt) {
  const JointOptions options;
  constexpr int kTurn = 600;
  SlowMotion motion = at_rest();
  double m = 0.0;
  int small = 0;
  for (int n = 1; n <= 12000; ++n) {
    const double d = 1.5 * (after_step(n, options) - after_step(n - kTurn, options));
    const double ratio = d * d / of_noise(options);
    m += (std::min(ratio, kMostRatio) - m) / options.motion_memory;
    const double expected = std::max(m, ratio / options.motion_sure);
    const double strength = motion.follow(n <= kTurn ? 1.8 : 0.3, 1.0, options, {});
    ASSERT_NEAR(strength, expected, 1e-8) << n;
    small = ratio > 1.0 ? 0 : small + 1;
    if (n > 60 && n <= kTurn) {
      ASSERT_GT(strength, 0.5 * (options.motion_low + options.motion_high)) << n;
    }
    if (small > kForgotten) {
      ASSERT_LT(strength, options.motion_low) << n;
    }
  }
  EXPECT_GT(small, kForgotten);
}

// The variance of d is what white noise of that variance makes of it: m has the mean 1. Standard error of
// m: 400 000 samples hold about 1500 independent d^2 of relative deviation sqrt(2).
TEST(SlowMotion, MeasuresInPartsOfWhiteNoise) {
  JointOptions options;
  options.motion_sure = 1e6;
  constexpr double kVariance = 0.49;
  SlowMotion motion;
  double sum = 0.0;
  double count = 0.0;
  for (const double z : testing::white_noise(400000, 7)) {
    const double strength = motion.follow(std::sqrt(kVariance) * z, kVariance, options, {});
    if (++count > 12000.0) sum += strength;
  }
  EXPECT_NEAR(sum / (count - 12000.0), 1.0, 0.15);
}

/// Share of the time in which noise of this deviation passes for motion, by as much as it does.
double mean_moving(double noise) {
  const JointOptions options;
  SlowMotion motion;
  static_cast<void>(strength_after(motion, testing::times(testing::white_noise(12000, 1), noise)));
  double sum = 0.0;
  for (const double z : testing::white_noise(100000, 2)) {
    const double strength = motion.follow(noise * z, 1.0, options, {});
    sum += std::clamp((strength - options.motion_low) / (options.motion_high - options.motion_low), 0.0, 1.0);
  }
  return sum / 100000.0;
}

// Real noise has up to half as much again where it is slow.
TEST(SlowMotion, NoiseIsNoMotion) {
  EXPECT_LT(mean_moving(1.0), 0.01);
  EXPECT_LT(mean_moving(std::sqrt(1.5)), 0.06);
}

TEST(SlowMotion, SlowSwingsAsLargeAsTheNoiseAre) {
  SlowMotion motion;
  Signal z = testing::white_noise(12000, 1);
  for (std::size_t n = 0; n < z.size(); ++n) z[n] += std::sin(0.01 * static_cast<double>(n));
  EXPECT_GT(strength_after(motion, z), JointOptions{}.motion_high);
}

// Without noise nothing can be told.
TEST(SlowMotion, WithoutNoiseAllMoves) {
  SlowMotion motion;
  EXPECT_EQ(strength_after(motion, Signal(7200, 0.3), 0.0), SlowMotion::kUntold);
}

TEST(SlowMotion, KeepsItsTimesInSeconds) {
  JointOptions longer;
  longer.correction_rate /= 4.0;
  longer.motion_mean *= 4.0;
  longer.motion_memory *= 4.0;
  SlowMotion scaled;
  SlowMotion expected;
  for (const double z : testing::white_noise(12000, 3)) {
    ASSERT_EQ(scaled.follow(z, 1.0, {}, JointScale(480.0, 4096)), expected.follow(z, 1.0, longer, {}));
  }
}

// What leaves the numbers is forgotten, and all begins anew.
TEST(SlowMotion, GoesOnAfterTheLargestNumbers) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  SlowMotion motion = at_rest();
  for (int n = 0; n < 100; ++n) {
    const double strength = motion.follow(n % 2 == 0 ? kLargest : -kLargest, 1.0, {}, {});
    EXPECT_GT(strength, JointOptions{}.motion_high) << n;
  }
  EXPECT_GT(motion.follow(0.3, kLargest, {}, {}), JointOptions{}.motion_high);
  motion = {};
  EXPECT_LT(strength_after(motion, Signal(7200, 0.3)), JointOptions{}.motion_low);
}

}  // namespace
}  // namespace gyrod
