// What the axes of a sensor share, and what is their own.
#include "core/joint/shared_motion.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/joint/start_noise.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;
using Axes = std::array<Signal, kSensorAxes>;

constexpr std::size_t kSamples = 1024;

/// Noise of its own in each axis, of these deviations.
Axes noise_alone(unsigned seed, const std::array<double, kSensorAxes>& deviations = {1.0, 1.0, 1.0},
                 std::size_t samples = kSamples) {
  Axes axes;
  for (unsigned axis = 0; axis < kSensorAxes; ++axis)
    axes[axis] = testing::times(testing::white_noise(samples, 3 * seed + axis), deviations[axis]);
  return axes;
}

/// And a body that shakes at all frequencies about an axis which is none of the sensor's, 30 times as strong.
Axes shaken(unsigned seed, std::size_t samples = kSamples) {
  Axes axes = noise_alone(seed, {1.0, 1.2, 0.9}, samples);
  const Signal shaking = testing::white_noise(samples, 1000 + seed);
  constexpr std::array kAxis = {18.0, -20.0, 14.0};
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis)
    axes[axis] = testing::sum(axes[axis], shaking, kAxis[axis]);
  return axes;
}

/// Mean over many windows of what is each axis's own, all bands.
template <typename Make>
std::array<double, kSensorAxes> mean_own(Make make, std::size_t samples = kSamples) {
  constexpr unsigned kWindows = 60;
  SharedMotion shared(kSamples, {});
  shared.set_sample_rate(100.0);
  std::array<double, kSensorAxes> mean{};
  for (unsigned seed = 0; seed < kWindows; ++seed) {
    const Axes axes = make(seed);
    shared.compare({std::span(axes[0]).first(samples), std::span(axes[1]).first(samples),
                    std::span(axes[2]).first(samples)});
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      for (const double own : shared.own(axis)) mean[axis] += own / kNoiseBands / kWindows;
    }
  }
  return mean;
}

// 1 / (S^-1)_ii, the textbook's residual variance of one on the others.
TEST(CrossPower, LeavesWhatLeastSquaresLeave) {
  const Axes axes = shaken(5);
  Eigen::Matrix3d products;
  CrossPower power;
  for (std::size_t i = 0; i < kSensorAxes; ++i) {
    for (std::size_t k = 0; k < kSensorAxes; ++k)
      products(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          std::inner_product(axes[i].begin(), axes[i].end(), axes[k].begin(), 0.0);
  }
  for (std::size_t i = 0; i < kSensorAxes; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    power.own[i] = products(at, at);
    power.shared[i] = products((at + 1) % 3, (at + 2) % 3);
  }
  const Eigen::Matrix3d inverse = products.inverse();
  for (std::size_t i = 0; i < kSensorAxes; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double left = 1.0 / inverse(at, at) / products(at, at);
    EXPECT_NEAR(power.unexplained(i, 1e9), left, 1e-6 * left) << i;
    EXPECT_NEAR(power.unexplained(i, 10.0), left * 10.0 / 8.0, 1e-6 * left) << i;
  }
}

TEST(CrossPower, OfOneSeriesIsItsOwn) {
  EXPECT_EQ((CrossPower{.own = {4.0, 0.0, 0.0}, .shared = {}}.unexplained(0, 10.0)), 1.0);
  EXPECT_EQ((CrossPower{.own = {0.0, 4.0, 0.0}, .shared = {}}.unexplained(0, 10.0)), 10.0 / 9.0);
  EXPECT_EQ((CrossPower{.own = {4.0, 4.0, 4.0}, .shared = {}}.unexplained(0, 2.0)), 1.0);
}

// Axes with the same samples come from a test bench, or a driver that is wrong: no sensor has the same noise twice.
TEST(CrossPower, TakesNothingOffCopies) {
  EXPECT_EQ((CrossPower{.own = {4.0, 4.0, 4.0}, .shared = {4.0, 4.0, 4.0}}.unexplained(0, 10.0)), 1.0);
  EXPECT_EQ((CrossPower{.own = {1.0, 4.0, 0.0}, .shared = {0.0, 0.0, -2.0}}.unexplained(0, 10.0)), 1.0);
  EXPECT_TRUE(std::isfinite(
      CrossPower{.own = {1e300, 1e300, 1e-300}, .shared = {1.0, 1.0, 1e300}}.unexplained(1, 9.0)));
}

TEST(SharedMotion, IsNoneInNoise) {
  for (const std::size_t samples : {kSamples, kSamples / 4, std::size_t{64}}) {
    const auto own = mean_own([](unsigned seed) { return noise_alone(seed); }, samples);
    for (const double share : own) EXPECT_NEAR(share, 1.0, samples == 64 ? 0.12 : 0.03) << samples;
  }
}

// What is left is at least the axis's own noise, and not much more: that of the others, as the motion is known from them.
TEST(SharedMotion, LeavesTheNoiseOfABodyThatShakes) {
  const auto own = mean_own([](unsigned seed) { return shaken(seed); });
  constexpr std::array kNoise = {1.0, 1.44, 0.81};
  constexpr std::array kAll = {325.0, 401.44, 196.81};
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    EXPECT_GT(own[axis] * kAll[axis], 0.95 * kNoise[axis]) << axis;
    EXPECT_LT(own[axis] * kAll[axis], 2.6 * kNoise[axis]) << axis;
  }
}

TEST(SharedMotion, NeedsASecondAxis) {
  const auto alone = mean_own([](unsigned seed) {
    return Axes{testing::white_noise(kSamples, seed), Signal(kSamples, 0.5), Signal(kSamples, 0.0)};
  });
  EXPECT_NEAR(alone[0], 1.0, 1e-12);
  const auto copies = mean_own([](unsigned seed) {
    const Signal one = testing::white_noise(kSamples, seed);
    return Axes{one, one, testing::times(one, -2.0)};
  });
  for (const double share : copies) EXPECT_NEAR(share, 1.0, 1e-9);
}

StartNoise after(const Axes& axes) {
  StartNoise start;
  for (std::size_t t = 0; t < axes[0].size(); ++t) start.step({axes[0][t], axes[1][t], axes[2][t]});
  return start;
}

TEST(StartNoise, IsTheVarianceOfWhiteNoise) {
  std::array<double, kSensorAxes> mean{};
  for (unsigned seed = 0; seed < 200; ++seed) {
    const StartNoise start = after(noise_alone(seed, {1.0, 1.2, 0.9}, 64));
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) mean[axis] += start.most(axis) / 200.0;
  }
  EXPECT_NEAR(mean[0], 1.0, 0.08);
  EXPECT_NEAR(mean[1], 1.44, 0.25);  // bounded by twice the quietest here and there
  EXPECT_NEAR(mean[2], 0.81, 0.07);
}

TEST(StartNoise, IsLittleOfABodyThatShakes) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const StartNoise start = after(shaken(seed, 64));
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      EXPECT_GT(start.most(axis), 0.3) << axis;
      EXPECT_LT(start.most(axis), 5.0) << axis;
    }
  }
}

TEST(StartNoise, SaysNothingAtFirstOrOfWhatNeverChanges) {
  const double none = std::numeric_limits<double>::infinity();
  EXPECT_EQ(after(noise_alone(1, {1.0, 1.0, 1.0}, 10)).most(0), none);
  EXPECT_LT(after(noise_alone(1, {1.0, 1.0, 1.0}, 14)).most(0), none);
  EXPECT_EQ(after({Signal(50, 0.0), Signal(50, 1.0), Signal(50, 2.0)}).most(1), none);
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(
      after({Signal{huge, -huge, huge, -huge, huge, huge, -huge}, Signal(7, 0.0), Signal(7, 0.0)}).most(0),
      none);
}

}  // namespace
}  // namespace gyrod::core
