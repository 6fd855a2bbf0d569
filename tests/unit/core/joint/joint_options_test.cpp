#include "core/joint/joint_options.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr JointOptions kOptions;

/// But for duration().
void expect_nothing_restated(const JointScale& scale) {
  EXPECT_EQ(scale.switching_rate(kOptions.switching_rate), kOptions.switching_rate);
  EXPECT_EQ(scale.agile_drive(kOptions.agile_drive), kOptions.agile_drive);
  EXPECT_EQ(scale.correction_rate(kOptions.correction_rate), kOptions.correction_rate);
  EXPECT_EQ(scale.pace(kOptions.most_steady_correction), kOptions.most_steady_correction);
  EXPECT_EQ(scale.memory(kOptions.steady_memory), kOptions.steady_memory);
  EXPECT_EQ(scale.recency(kOptions.recency), kOptions.recency);
  EXPECT_EQ(scale.shrinkage(kOptions.shrinkage), kOptions.shrinkage);
  EXPECT_EQ(scale.forgetting(1.0), 1.0);
}

TEST(JointScale, LeavesAllAsItIsAtTheDesignAndWhereTheRateIsUnknown) {
  EXPECT_EQ(JointScale(kDesignRateHz, kDesignWindowSamples), JointScale());
  for (const double unknown :
       {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(JointScale(unknown, kDesignWindowSamples), JointScale());
  }
  expect_nothing_restated(JointScale());
}

TEST(JointScale, LeavesSlowSensorsAndLongWindowsAsTheyAre) {
  EXPECT_EQ(JointScale(120.0, 2 * kDesignWindowSamples), JointScale());
  expect_nothing_restated(JointScale(60.0, kDesignWindowSamples));
}

TEST(JointScale, DurationsAreTheSameSecondsAtEveryRate) {
  EXPECT_EQ(JointScale(60.0, kDesignWindowSamples).duration(512.0), 256.0);
  EXPECT_EQ(JointScale(480.0, kDesignWindowSamples).duration(512.0), 2048.0);
  EXPECT_EQ(JointScale(60.0, kDesignWindowSamples).duration(1.5), 1.0);
}

// Quarters of an octave from 120 Hz on: 200 Hz is 120 * 2^(3/4) = 201.8 Hz.
TEST(JointScale, ATrembleOfTheRateChangesNothing) {
  EXPECT_EQ(JointScale(199.7, 1024), JointScale(200.4, 1024));
  EXPECT_EQ(JointScale(119.2, 1024), JointScale(121.0, 1024));
  EXPECT_NE(JointScale(200.0, 1024), JointScale(400.0, 1024));
  EXPECT_NEAR(JointScale(200.0, 1024).memory(1.0), std::exp2(0.75), 1e-15);
}

// Four samples at 480 Hz last as long as one at 120 Hz; half a window gives twice the models in the same time.
TEST(JointScale, MembersGiveWayAsOftenASecondAndMoreOftenInShortWindows) {
  EXPECT_EQ(JointScale(480.0, 1024).switching_rate(0.002), 0.0005);
  EXPECT_EQ(JointScale(120.0, 512).switching_rate(0.002), 0.004);
}

// A random walk of drive q seen in white noise of variance 1 is followed with the gain K = (sqrt(q^2 + 4 q) - q) / 2, an exponential average
// of bandwidth K f / (2 pi) Hz, K = sqrt(q) (1 - sqrt(q) / 2 + ...): alike to the second term, which is 7 % at q = 0.02.
TEST(JointScale, AnAgileLevelHasTheSameBandwidth) {
  const auto bandwidth = [](double q, double rate_hz) {
    return 0.5 * (std::sqrt(q * q + 4.0 * q) - q) * rate_hz;
  };
  const double q = kOptions.agile_drive;
  const double fast = JointScale(480.0, 1024).agile_drive(q);
  EXPECT_NEAR(bandwidth(fast, 480.0) / bandwidth(q, 120.0), 1.0, 0.07);
}

// recency / window seconds is what the tapers fall off with.
TEST(JointScale, ShortWindowsLookBackForTheSameSeconds) {
  const double design = 3.0 * kDesignRateHz / 1024.0;
  EXPECT_NEAR(JointScale(480.0, 1024).recency(3.0) * 480.0 / 1024.0, design, 1e-15);
  EXPECT_NEAR(JointScale(120.0, 512).recency(3.0) * 120.0 / 512.0, design, 1e-15);
  EXPECT_NEAR(JointScale(480.0, 4096).recency(3.0), 3.0, 1e-15);
  EXPECT_NEAR(JointScale(60.0, 512).recency(3.0), 3.0, 1e-15);
}

TEST(JointScale, ShortWindowsTrustThePriorMoreUpToALimit) {
  EXPECT_NEAR(JointScale(120.0, 512).shrinkage(0.01), 0.02, 1e-15);
  EXPECT_NEAR(JointScale(480.0, 1024).shrinkage(0.01), 0.04, 1e-15);
  EXPECT_EQ(JointScale(8000.0, 64).shrinkage(0.01), 0.1);
}

TEST(JointScale, WhatIsSteadyIsSoForTheSameSeconds) {
  EXPECT_EQ(JointScale(480.0, 1024).memory(512.0), 2048.0);
  EXPECT_EQ(JointScale(120.0, 512).memory(512.0), 512.0);
}

// A window of the design forgets a share; a window of a quarter of its seconds a quarter.
TEST(JointScale, ForgetsInTheSameSeconds) {
  EXPECT_NEAR(JointScale(480.0, 1024).forgetting(0.03), 0.0075, 1e-15);
  EXPECT_NEAR(JointScale(120.0, 512).forgetting(0.03), 0.015, 1e-15);
  EXPECT_EQ(JointScale(480.0, 4096).forgetting(0.03), 0.03);
}

TEST(JointScale, GivesBackTheSamePartInTheSameSeconds) {
  EXPECT_EQ(JointScale(480.0, 1024).pace(0.04), 0.01);
  EXPECT_EQ(JointScale(50.0, 1024).pace(0.04), 0.04);
  EXPECT_EQ(JointScale(120.0, 256).pace(0.04), 0.04);
}

// Half the samples, twice the rate, whatever the seconds.
TEST(JointScale, TheCorrectionKeepsPaceWithTheWindow) {
  EXPECT_NEAR(JointScale(120.0, 512).correction_rate(0.004), 0.008, 1e-15);
  EXPECT_EQ(JointScale(480.0, 1024).correction_rate(0.004), 0.001);
  EXPECT_EQ(JointScale(120.0, 2048).correction_rate(0.004), 0.004);
  EXPECT_EQ(JointScale(120.0, 16).correction_rate(0.004), 0.1);
}

}  // namespace
}  // namespace gyrod::core
