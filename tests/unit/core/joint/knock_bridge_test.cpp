// What of a window counts as a knock, and what takes its place.
#include "core/joint/knock_bridge.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::JointOptions;
using core::KnockBridge;
using testing::Signal;

constexpr std::size_t kWindow = 1024;

/// Adds a tap that rings for some samples.
void tap(Signal& x, std::size_t at, double amplitude) {
  for (std::size_t n = 0; n < 60 && at + n < x.size(); ++n) {
    const auto t = static_cast<double>(n);
    x[at + n] += amplitude * std::exp(-t / 6.0) * std::sin(1.3 * t + 1.0);
  }
}

std::size_t bridged(Signal& x, const JointOptions& options = {}) {
  KnockBridge bridge(x.size());
  return bridge.apply(x, options);
}

/// Samples that a call changes.
std::size_t changed(const Signal& x) {
  Signal copy = x;
  bridged(copy);
  std::size_t count = 0;
  for (std::size_t n = 0; n < x.size(); ++n) count += copy[n] != x[n] ? 1U : 0U;
  return count;
}

TEST(KnockBridge, AStraightLineTakesTheKnocksPlace) {
  constexpr std::size_t kAt = 400;
  const Signal noise = testing::white_noise(kWindow, 1);
  Signal x = noise;
  tap(x, kAt, 500.0);
  const Signal before = x;
  const std::size_t count = bridged(x);
  EXPECT_GE(count, 20U);
  EXPECT_LE(count, 60U);
  std::size_t first = kWindow;
  std::size_t last = 0;
  for (std::size_t n = 0; n < kWindow; ++n) {
    if (x[n] == before[n]) continue;
    first = std::min(first, n);
    last = n;
  }
  EXPECT_EQ(last - first + 1, count);
  EXPECT_LE(first, kAt);
  EXPECT_GE(first, kAt - 8);
  for (std::size_t n = first; n <= last; ++n) EXPECT_NEAR(x[n - 1] - 2.0 * x[n] + x[n + 1], 0.0, 1e-12) << n;
  // What is left of the tap is of the size of noise.
  EXPECT_LT(std::abs(before[last + 1] - noise[last + 1]), 8.0);
}

// A bit that a bus got wrong: one sample of 20 deviations has second differences of 20, -40 and 20, 9 means of up to 6 * 400 / 9 beside 6: 44 times.
TEST(KnockBridge, TakesSingleSamplesOfTwentyDeviations) {
  Signal x = testing::white_noise(kWindow, 3);
  for (const std::size_t at : {100U, 400U, 401U + 300U}) x[at] += at == 400U ? -20.0 : 20.0;
  Signal copy = x;
  EXPECT_GE(bridged(copy), 3U);
  for (const std::size_t at : {100U, 400U, 701U}) EXPECT_LT(std::abs(copy[at]), 5.0) << at;
}

TEST(KnockBridge, LeavesNoiseAlone) {
  for (unsigned seed = 1; seed <= 200; ++seed)
    EXPECT_EQ(changed(testing::white_noise(kWindow, seed)), 0U) << seed;
}

TEST(KnockBridge, LeavesMotionAlone) {
  const Signal noise = testing::white_noise(kWindow, 2);
  Signal turn = noise;  // 10 deg/s within 0.3 s at 100 Hz, noise 0.1 deg/s
  for (std::size_t n = 500; n < kWindow; ++n)
    turn[n] += 100.0 * std::min(1.0, static_cast<double>(n - 500) / 30.0);
  EXPECT_EQ(changed(turn), 0U);
  EXPECT_EQ(changed(testing::sum(noise, testing::tone(kWindow, 0.2), 100.0)), 0U);  // an engine
  Signal bumps = noise;                                                             // a road
  for (std::size_t at = 50; at < kWindow; at += 100) tap(bumps, at, 8.0);
  EXPECT_EQ(changed(bumps), 0U);
}

// A vibration that has just begun must be learned at once, and not in the quarter of a window that knocks may be.
TEST(KnockBridge, LeavesAloneWhatIsNotOver) {
  Signal x = testing::white_noise(kWindow, 3);
  for (std::size_t n = kWindow - 50; n < kWindow; ++n) x[n] += 100.0 * std::sin(1.2 * static_cast<double>(n));
  EXPECT_EQ(changed(x), 0U);
  Signal y = testing::white_noise(kWindow, 3);
  for (std::size_t n = kWindow - 100; n < kWindow - 50; ++n)
    y[n] += 100.0 * std::sin(1.2 * static_cast<double>(n));
  EXPECT_NEAR(static_cast<double>(changed(y)), 54.0, 8.0);
}

TEST(KnockBridge, LeavesAWindowThatIsAboutShaking) {
  Signal few = testing::white_noise(kWindow, 4);
  for (std::size_t at = 0; at < kWindow - 100; at += 250) tap(few, at, 500.0);
  EXPECT_GT(changed(few), 100U);  // the first begins before the window does
  Signal many = testing::white_noise(kWindow, 4);
  for (std::size_t at = 0; at < kWindow - 100; at += 80) tap(many, at, 500.0);
  EXPECT_EQ(changed(many), 0U);
}

TEST(KnockBridge, OfAWindowThatHardlyChangesNothingIsAKnock) {
  Signal x(
      kWindow,
      1.0);  // a coarse converter at rest: most second differences are zero, and nothing tells what is usual
  x[300] = 2.0;
  x[301] = -1.0;
  EXPECT_EQ(changed(x), 0U);
  EXPECT_EQ(changed(Signal(8, 1.0)), 0U);
}

TEST(KnockBridge, KnowsNoUnit) {
  Signal x = testing::white_noise(kWindow, 5);
  tap(x, 700, 300.0);
  Signal small = testing::times(x, 0x1p-200);
  bridged(x);
  bridged(small);
  EXPECT_EQ(small, testing::times(x, 0x1p-200));
}

// In +1, -1, .. second differences are 4 everywhere. One sample that is 1000 off makes three of them large, which five samples to either side see in their
// means of nine.
TEST(KnockBridge, AKnockIsAsWideAsTheMeansThatSeeIt) {
  Signal x(200);
  for (std::size_t n = 0; n < x.size(); ++n) x[n] = n % 2 == 0 ? 1.0 : -1.0;
  x[100] += 1000.0;
  Signal copy = x;
  EXPECT_EQ(bridged(copy), 11U);
  for (const std::size_t untouched : {94U, 106U}) EXPECT_EQ(copy[untouched], x[untouched]);
  for (std::size_t n = 95; n <= 105; ++n) EXPECT_NEAR(copy[n], 1.0, 1e-12) << n;
}

// Nothing is known of what was before the window: what comes after the knock stands for it.
TEST(KnockBridge, AKnockAtTheBeginningIsAsTheSampleAfterIt) {
  Signal x = testing::white_noise(kWindow, 6);
  for (double& value : x) value += 50.0;
  tap(x, 0, 500.0);
  const std::size_t count = bridged(x);
  ASSERT_GT(count, 10U);
  for (std::size_t n = 0; n < count; ++n) EXPECT_EQ(x[n], x[count]) << n;
}

}  // namespace
}  // namespace gyrod
