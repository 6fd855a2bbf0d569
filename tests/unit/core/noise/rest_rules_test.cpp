// The numbers of docs/noise.md, "What counts as rest": a little below each limit is rest, a little above it is not.
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>

#include <gtest/gtest.h>

#include "core/noise/rest_detector.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

constexpr std::size_t kBlocksRun = 40;
/// Mean and standard deviation of block number b.
using BlockLaw = std::function<std::array<double, 2>(std::size_t b)>;

/// White noise whose blocks have exactly these means and standard deviations.
Signal blocks(std::size_t block_samples, unsigned seed, const BlockLaw& law) {
  Signal x = testing::white_noise(kBlocksRun * block_samples, seed);
  for (std::size_t b = 0; b < kBlocksRun; ++b) {
    const std::span<double> block{x.data() + b * block_samples, block_samples};
    double mean = 0.0;
    for (const double value : block) mean += value / static_cast<double>(block_samples);
    double variance = 0.0;
    for (const double value : block) variance += (value - mean) * (value - mean);
    const double scale = std::sqrt(static_cast<double>(block_samples) / variance);
    const auto [its_mean, its_deviation] = law(b);
    for (double& value : block) value = its_mean + its_deviation * scale * (value - mean);
  }
  return x;
}

std::array<double, 2> quiet(std::size_t /*b*/) { return {0.0, 1.0}; }

/// Blocks that ended with this verdict, of x and, where there is one, of an accelerometer's x.
std::size_t ended(RestVerdict verdict, double rate_hz, const Signal& x, const Signal* force = nullptr) {
  RestDetector detector(rate_hz);
  const Signal y = blocks(detector.block_samples(), 2, quiet);
  std::size_t count = 0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const Triple specific_force = {force == nullptr ? 0.0 : (*force)[n], 0.0, 9.81};
    const bool end = detector.step({x[n], y[n], y[n]}, force == nullptr ? nullptr : &specific_force);
    count += end && detector.verdict() == verdict ? 1U : 0U;
  }
  return count;
}

/// All but the first eight: of a block that is judged there are eight, and two segments.
constexpr std::size_t kAllBlocks = kBlocksRun - RestDetector::kBlocks;

/// Every other block has this many times the variance.
BlockLaw uneven(double ratio) {
  return [ratio](std::size_t b) { return std::array{0.0, b % 2 == 0 ? 1.0 : std::sqrt(ratio)}; };
}

// exp(7.5 sqrt(2 / n)): 2.89 for blocks of 100; 400 samples at most count, which gives 1.70 for blocks of 1000, too (1.40 without that).
TEST(RestRules, LevelsOfBlocksMayDifferByWhatChanceAllowsThem) {
  struct Case {
    double rate_hz, within, beyond;
  };
  for (const auto& [rate_hz, within, beyond] :
       {Case{100.0, 2.8, 2.98}, Case{400.0, 1.65, 1.75}, Case{1000.0, 1.65, 1.75}}) {
    const auto samples = static_cast<std::size_t>(rate_hz);
    EXPECT_GE(ended(RestVerdict::kRest, rate_hz, blocks(samples, 1, uneven(within))), kAllBlocks) << rate_hz;
    EXPECT_EQ(ended(RestVerdict::kRest, rate_hz, blocks(samples, 1, uneven(beyond))), 0U) << rate_hz;
  }
}

/// Means +m and -m in turn: of eight blocks the variance is 8 / 7 m^2, and that of white noise's means 1 / n.
BlockLaw wandering(double ratio) {
  const double m = std::sqrt(ratio * 7.0 / 8.0 / 100.0);
  return [m](std::size_t b) { return std::array{b % 2 == 0 ? m : -m, 1.0}; };
}

TEST(RestRules, MeansOfBlocksMayWanderByEightTimesWhatWhiteNoisesDo) {
  EXPECT_GE(ended(RestVerdict::kRest, 100.0, blocks(100, 1, wandering(7.5))), kAllBlocks);
  EXPECT_EQ(ended(RestVerdict::kRest, 100.0, blocks(100, 1, wandering(8.5))), 0U);
  EXPECT_GE(ended(RestVerdict::kWandering, 100.0, blocks(100, 1, wandering(8.5))), kAllBlocks);
}

TEST(RestRules, AnAccelerometersMayWanderByTwentyFourTimes) {
  const Signal still = blocks(100, 1, quiet);
  for (const double ratio : {9.0, 23.0, 25.0}) {
    const Signal force = blocks(100, 3, wandering(ratio));
    EXPECT_EQ(ended(RestVerdict::kRest, 100.0, still, &force) >= kAllBlocks, ratio < 24.0) << ratio;
  }
}

// A tone of amplitude a in noise of variance 1 has the part a^2 / 2 / (1 + a^2 / 2) of the power, of which 2.5 times the noise of the few bins that it
// fills is taken for noise: 1 %. The part found in a few segments varies by some 2 %.
TEST(RestRules, ALineMayHaveTwoFifthsOfThePower) {
  for (const double part : {0.32, 0.48}) {
    const double amplitude = std::sqrt(2.0 * part / (1.0 - part));
    const Signal x = testing::sum(blocks(100, 1, quiet), testing::tone(100 * kBlocksRun, 0.31), amplitude);
    const RestVerdict expected = part < 0.4 ? RestVerdict::kRest : RestVerdict::kTone;
    EXPECT_GE(ended(expected, 100.0, x), kAllBlocks) << part;
  }
}

}  // namespace
}  // namespace gyrod::core
