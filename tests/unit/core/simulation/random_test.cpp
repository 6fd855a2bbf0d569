/// The generator and the elementary functions under the simulator.
#include "core/simulation/random.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/simulation/oscillator.hpp"
#include "unit/core/simulation/simulation_support.hpp"

namespace gyrod::core {
namespace {

TEST(Random, GivesThePublishedSequence) {
  // xoshiro256++ seeded with splitmix64, as the authors' C code gives it; computed apart from ours with
  // Python's integers.
  Random zero(0);
  for (const std::uint64_t expected :
       {0x53175D61490B23DFU, 0x61DA6F3DC380D507U, 0x5C0FDF91EC9A7BFCU, 0x02EEBF8C3BBE5E1AU}) {
    EXPECT_EQ(zero.next(), expected);
  }
}

TEST(Random, UniformStaysInItsRangeAndFillsIt) {
  Random random(7);
  double least = 1.0;
  double most = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0.0);
    ASSERT_LT(value, 1.0);
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // Chance that all miss one of the thousandths at the ends: 2 (1 - 0.001)^100000 = 7e-44.
  EXPECT_LT(least, 0.001);
  EXPECT_GT(most, 0.999);
}

TEST(Random, NormalHasTheMomentsOfANormalDistribution) {
  constexpr std::size_t kValues = 400'000;
  Random random(11);
  double sum1 = 0.0;
  double sum2 = 0.0;
  double sum3 = 0.0;
  double sum4 = 0.0;
  for (std::size_t i = 0; i < kValues; ++i) {
    const double x = random.normal();
    sum1 += x;
    sum2 += x * x;
    sum3 += x * x * x;
    sum4 += x * x * x * x;
  }
  const auto n = static_cast<double>(kValues);
  // Four standard errors: those of the moments of n normal values are sqrt(1, 2, 15, 96) / sqrt(n).
  const double four = 4.0 / std::sqrt(n);
  EXPECT_NEAR(sum1 / n, 0.0, four);
  EXPECT_NEAR(sum2 / n, 1.0, four * std::sqrt(2.0));
  EXPECT_NEAR(sum3 / n, 0.0, four * std::sqrt(15.0));
  EXPECT_NEAR(sum4 / n, 3.0, four * std::sqrt(96.0));
}

TEST(Oscillator, FollowsTheSineForAMillionSamples) {
  constexpr double kTurns = 0.123;
  Oscillator oscillator(kTurns, 0.25);
  for (int i = 0; i < 1'000'000; ++i) {
    const double turns = std::remainder(kTurns * i + 0.25, 1.0);
    // Rounding of the step's angle adds up: 1e6 steps of at most 1e-15 turns.
    ASSERT_NEAR(oscillator.next(), std::sin(2.0 * std::numbers::pi * turns), 1e-8) << i;
  }
}

TEST(Oscillator, IsSilentWithoutAFrequency) {
  Oscillator oscillator;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(oscillator.next(), 0.0);
}

}  // namespace
}  // namespace gyrod::core
