#include "core/noise/axis_spectra.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/noise/noise_lines.hpp"
#include "core/noise/still_noise.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

constexpr double kForEver = std::numeric_limits<double>::infinity();
constexpr std::array<bool, 3> kAll = {true, true, true};

/// Independent on each axis, of power 1.
AxisTransforms independent(std::mt19937_64& bits) {
  std::normal_distribution<double> normal(0.0, std::sqrt(0.5));
  AxisTransforms transforms;
  for (auto& axis : transforms) {
    for (auto& bin : axis) bin = {normal(bits), normal(bits)};
  }
  return transforms;
}

/// Of so many segments. @param change what to do to each
template <class Change>
AxisSpectra averaged(int segments, unsigned seed, Change change) {
  std::mt19937_64 bits(seed);
  AxisSpectra spectra;
  for (int s = 0; s < segments; ++s) {
    AxisTransforms transforms = independent(bits);
    change(transforms, s);
    AxisSums sums;
    sums.add(transforms);
    spectra.blend(sums, kAll, kForEver);
  }
  return spectra;
}

TEST(AxisSpectra, ProductsAreOfTheTwoOtherAxes) {
  AxisTransforms transforms{};
  transforms[0][7] = {1.0, 2.0};
  transforms[1][7] = {3.0, -1.0};
  transforms[2][7] = {0.0, 4.0};
  AxisSums sums;
  sums.add(transforms);
  sums.add(transforms);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto expected = 2.0 * transforms[next_axis(axis)][7] * std::conj(transforms[last_axis(axis)][7]);
    EXPECT_EQ(sums.cross[axis][7], expected) << axis;
    EXPECT_EQ(sums.power[axis][7], 2.0 * std::norm(transforms[axis][7])) << axis;
  }
  EXPECT_EQ(sums.count, 2.0);
}

TEST(AxisSpectra, AverageWithTheWeightOfTheLast) {
  AxisSums ones;
  for (auto& axis : ones.power) axis.fill(2.0);
  ones.count = 2.0;
  AxisSums threes = ones;
  for (auto& axis : threes.power) axis.fill(6.0);
  AxisSpectra spectra;
  spectra.blend(ones, kAll, 4.0);
  EXPECT_EQ(spectra.power[1][9], 1.0);
  for (int more = 0; more < 3; ++more) spectra.blend(threes, kAll, 4.0);
  // Two of four segments are new each time: 1, 2, 2.5, 2.75.
  EXPECT_EQ(spectra.power[1][9], 2.75);
  EXPECT_EQ(spectra.segments[1], 4.0);
  ones.count = 1.0;
  spectra.blend(ones, {true, false, true}, 5.0);
  EXPECT_EQ(spectra.power[1][9], 2.75) << "an axis that is not alive keeps what it has";
  EXPECT_LT(spectra.power[0][9], 2.75);
  EXPECT_EQ(spectra.cross_segments, (std::array{4.0, 5.0, 4.0})) << "nor has it anything with another";
}

// However it is turned from one axis to the other: an engine's shake is a circle as often as a line.
TEST(AxisSpectra, WhatIsTheSameOnTwoAxesIsShared) {
  for (const double turns : {0.0, 0.25, 0.6}) {
    const std::complex<double> phase = std::polar(0.5, 2.0 * std::numbers::pi * turns);
    const AxisSpectra spectra = averaged(10, 1, [&](AxisTransforms& t, int) { t[2][20] = phase * t[0][20]; });
    EXPECT_NEAR(spectra.shared(0, 20, 20), 1.0, 1e-12);
    EXPECT_NEAR(spectra.shared(2, 20, 20), 1.0, 1e-12);
    EXPECT_EQ(spectra.shared(0, 40, 40), 0.0);
  }
}

// A line that makes floors of 1 r and s times as high: (1 - 1 / r) (1 - 1 / s).
TEST(AxisSpectra, ALineInNoiseIsSharedAsFarAsItStandsOut) {
  const double r = 9.0;
  const double s = 3.0;
  const AxisSpectra spectra = averaged(4000, 2, [&](AxisTransforms& t, int segment) {
    const auto line = std::polar(1.0, 0.7 * segment);
    t[0][50] += std::sqrt(r - 1.0) * line;
    t[1][50] += std::sqrt(s - 1.0) * std::complex(0.0, 1.0) * line;
  });
  const double expected = (1.0 - 1.0 / r) * (1.0 - 1.0 / s);
  EXPECT_NEAR(spectra.shared(0, 50, 50), expected, 0.03);
  EXPECT_NEAR(spectra.shared(1, 50, 50), expected, 0.03);
  EXPECT_LT(spectra.shared(2, 50, 50), 0.01);
}

TEST(AxisSpectra, IndependentNoiseIsSharedByChanceInOneOfAHundred) {
  for (const int segments : {5, 12, 100}) {
    double pairs = 0.0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      const AxisSpectra spectra = averaged(segments, seed, [](AxisTransforms&, int) {});
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t k = 3; k + 1 < kNoiseBins; ++k)
          pairs += spectra.shared(axis, k, k) > 0.0 ? 1.0 : 0.0;
      }
    }
    // Two other axes each. 15 000 questions; four standard errors of 1.2 % beside.
    EXPECT_NEAR(pairs / (20.0 * 3.0 * 253.0), 0.0199, 0.005) << segments;
  }
}

TEST(AxisSpectra, NothingIsSharedOfWhatIsNotThere) {
  EXPECT_EQ(AxisSpectra{}.shared(0, 3, 200), 0.0);
  AxisSums one;
  one.add(AxisTransforms{});
  AxisSpectra spectra;
  spectra.blend(one, {true, false, false}, kForEver);
  EXPECT_EQ(spectra.shared(0, 3, 200), 0.0);
}

/// Ten minutes at 100 Hz of white noise of 1 on x, y, z.
std::array<Signal, 3> still() {
  return {testing::white_noise(60'000, 1), testing::white_noise(60'000, 2), testing::white_noise(60'000, 3)};
}

std::array<StillAxis, 3> learned(const std::array<Signal, 3>& axes) {
  const AxisSamples samples = {axes[0], axes[1], axes[2]};
  return still_noise(std::span(&samples, 1));
}

void expect_a_line_of_its_own_on_each(const std::array<Signal, 3>& axes) {
  for (const StillAxis& axis : learned(axes)) {
    ASSERT_TRUE(axis.model);
    EXPECT_EQ(axis.model->line_count, 1U);
    EXPECT_EQ(axis.shared_count, 0U);
  }
}

// An idling engine's, a sixth and a twentieth of the variance, a quarter turn apart (WID trial 06 has 0.46 and 0.30 deg/s at 22.5 Hz).
TEST(SharedLines, AreAnEnginesAndNotOfTheModel) {
  auto axes = still();
  axes[0] = testing::sum(axes[0], testing::tone(60'000, 0.225), 0.6);
  axes[1] = testing::sum(axes[1], testing::tone(60'000, 0.225, 1.6), 0.35);
  const auto axis = learned(axes);
  for (std::size_t a = 0; a < 3; ++a) {
    ASSERT_TRUE(axis[a].model);
    EXPECT_EQ(axis[a].model->line_count, 0U) << a;
    EXPECT_NEAR(noise_variance(*axis[a].model), 1.0, 0.025) << a;
    ASSERT_EQ(axis[a].shared_count, a < 2 ? 1U : 0U);
  }
  EXPECT_NEAR(axis[0].shared[0].cycles, 0.225, 1e-4);
  EXPECT_NEAR(axis[0].shared[0].variance, 0.18, 0.01);
  EXPECT_NEAR(axis[1].shared[0].variance, 0.06125, 0.006);
}

// Each gyro has its own drive: lines side by side, even at one frequency, know nothing of each other.
TEST(SharedLines, ASensorsOwnLinesAreItsNoise) {
  auto axes = still();
  const std::array<double, 2> resonance = {2.0 * 0.99 * std::cos(2.0 * std::numbers::pi * 0.2), -0.99 * 0.99};
  for (std::size_t a = 0; a < 2; ++a)
    axes[a] =
        testing::sum(axes[a], testing::autoregressive(resonance, 60'000, 7 + static_cast<unsigned>(a)), 0.05);
  axes[2] = testing::sum(axes[2], testing::tone(60'000, 0.31), 0.6);
  expect_a_line_of_its_own_on_each(axes);
}

// A bench adds the noise of one axis to all: there the line is as much the noise's as all the rest.
TEST(SharedLines, ACopyOfAnAxisTellsNothing) {
  auto axes = still();
  axes[0] = testing::sum(axes[0], testing::tone(60'000, 0.225), 0.6);
  axes[1] = axes[0];
  axes[2] = testing::times(axes[0], 0.5);
  expect_a_line_of_its_own_on_each(axes);
}

TEST(SharedLines, DoNotHideTheSensorsOwn) {
  auto axes = still();
  for (std::size_t a = 0; a < 2; ++a) {
    for (const double cycles : {0.06, 0.12, 0.18, 0.24})
      axes[a] = testing::sum(axes[a], testing::tone(60'000, cycles), 0.6);
  }
  axes[0] = testing::sum(axes[0], testing::tone(60'000, 0.37), 0.4);
  const StillAxis x = learned(axes)[0];
  ASSERT_EQ(x.model->line_count, 1U);
  EXPECT_NEAR(x.model->line[0].cycles, 0.37, 1e-4);
  EXPECT_EQ(x.shared_count, 4U);
}

}  // namespace
}  // namespace gyrod::core
