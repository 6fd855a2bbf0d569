#include "core/joint/line_tracker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "line_support.hpp"
#include "support/allocation_counter.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::line;
using testing::Signal;

constexpr std::size_t kSamples = 1024;
constexpr std::size_t kBins = kSamples / 2 + 1;
constexpr double kShare = 1.0 / 32.0;
constexpr double kPower = 0.5;
constexpr LineOptions kOptions;
/// From one place to the next.
constexpr double kStep = 2.0 * LineTracker::kReach * 0.2 / static_cast<double>(LineTracker::kPlaces - 1);

/// The spectrum of a narrow line of this variance: that of a mode or of a window that holds it.
Signal line_at(double cycles, double power) {
  const NoiseModel with = testing::noise_with_resonance(cycles, power);
  Signal spectrum(kBins);
  for (std::size_t k = 0; k < kBins; ++k) {
    spectrum[k] =
        noise_spectrum(with, std::numbers::pi * static_cast<double>(k) / static_cast<double>(kBins - 1)) -
        1.0;
  }
  return spectrum;
}

/// White noise of 1 and these.
Signal window_with(const Signal& a, const Signal& b = Signal(kBins, 0.0)) {
  Signal sum(kBins, 1.0);
  for (std::size_t k = 0; k < kBins; ++k) sum[k] += a[k] + b[k];
  return sum;
}

/// Told of a line at 0.2.
LineTracker tracker_at_first() {
  LineTracker tracker;
  tracker.believe(line(0.2, kPower));
  return tracker;
}

LineEvidence evidence(const Signal& window, const Signal& rest, const Signal& explained) {
  return {.periodogram = window,
          .rest = rest,
          .explained = explained,
          .resolution = 1.0 / kSamples,
          .power = kPower,
          .share = kShare};
}

/// So many windows' times of the same window.
void watch(LineTracker& tracker, const Signal& window, const Signal& motion, double windows = 10.0) {
  const Signal rest(kBins, 1.0);
  for (double time = 0.0; time < windows; time += kShare) {
    tracker.observe(evidence(window, rest, motion), kOptions);
  }
}

const Signal kNoMotion(kBins, 0.0);

TEST(LineTracker, ThereIsNoneWhereNoneIsBelieved) {
  const LineTracker tracker;
  EXPECT_EQ(tracker.line(kOptions).power, 0.0);
  EXPECT_FALSE(tracker.line(kOptions).reaches(0.0, kOptions));
}

TEST(LineTracker, BeginsWithWhatIsBelieved) {
  const NoiseLine line = tracker_at_first().line(kOptions);
  EXPECT_NEAR(line.cycles, 0.2, kStep);
  EXPECT_EQ(line.power, kPower);
}

// Its own width is what the calibration says, no less than 0.3 % and no more than 1.25 % of its frequency; what is not known of its place comes on top.
TEST(LineTracker, IsAsWideAsItWasMeasured) {
  const auto width_of = [](double half_width) {
    LineTracker tracker;
    tracker.believe({.cycles = 0.2, .half_width = half_width, .variance = kPower});
    return tracker.line(kOptions).half_width - tracker.place().deviation;
  };
  EXPECT_NEAR(width_of(0.0015), 0.0015, 1e-6);
  EXPECT_NEAR(width_of(1e-6), 0.003 * 0.2, 1e-5);
  EXPECT_NEAR(width_of(0.01), 0.0125 * 0.2, 1e-4);
}

// The process that the filters get has the line's variance and its frequency.
TEST(LineTracker, ItsModeHasItsPowerAndFrequency) {
  const NoiseLine line = tracker_at_first().line(kOptions);
  NoiseModel alone = white_noise(1.0);
  alone.colour_order = 2;
  alone.colour = {line.mode.a[0], line.mode.a[1]};
  alone.colour_variance = line.mode.drive;
  EXPECT_NEAR(noise_variance(alone) - 1.0, line.power, 1e-9);
  const auto at = [&alone](double cycles) {
    return noise_spectrum(alone, 2.0 * std::numbers::pi * cycles) - 1.0;
  };
  EXPECT_NEAR(at(line.cycles + line.half_width) / at(line.cycles), 0.5, 0.02);
}

TEST(LineTracker, FindsALineThatHasMoved) {
  for (const double cycles : {0.165, 0.19, 0.2, 0.225, 0.24}) {
    LineTracker tracker = tracker_at_first();
    watch(tracker, window_with(line_at(cycles, kPower)), kNoMotion);
    EXPECT_NEAR(tracker.place().cycles, cycles, kStep);
    EXPECT_LT(tracker.place().deviation, 2.0 * kStep);
  }
}

TEST(LineTracker, FollowsALineThatGoesOnMoving) {
  LineTracker tracker = tracker_at_first();
  for (double cycles = 0.2; cycles < 0.23; cycles += 0.001) {
    watch(tracker, window_with(line_at(cycles, kPower)), kNoMotion, 2.0);
    EXPECT_NEAR(tracker.place().cycles, cycles, 2.0 * kStep);
  }
}

// The fit knew the line elsewhere and has made a mode of it, or has made none: that is the same line.
TEST(LineTracker, WhatTheFitTookForMotionIsFoundAllTheSame) {
  const Signal line = line_at(0.225, kPower);
  LineTracker tracker = tracker_at_first();
  watch(tracker, window_with(line), line);
  EXPECT_NEAR(tracker.place().cycles, 0.225, kStep);
}

// An engine's tone with a quarter of the line's power, in a mode of its own: the line is where its power is.
TEST(LineTracker, AWeakerToneIsNotTheLine) {
  const Signal engine = line_at(0.18, 0.25 * kPower);
  const Signal line = line_at(0.225, kPower);
  LineTracker tracker = tracker_at_first();
  watch(tracker, window_with(line, engine), window_with(line, engine));
  EXPECT_NEAR(tracker.place().cycles, 0.225, 2.0 * kStep);
}

// A vibration far stronger than the line, which a mode explains, says nothing of the line: it is known no better than before.
TEST(LineTracker, StrongShakingAllOverSaysNothing) {
  const Signal shaking(kBins, 300.0);
  LineTracker tracker = tracker_at_first();
  const LinePlace before = tracker.place();
  watch(tracker, window_with(shaking), shaking);
  EXPECT_NEAR(tracker.place().cycles, before.cycles, kStep);
  EXPECT_NEAR(tracker.place().deviation, before.deviation, kStep);
}

// A tone far stronger than the line, which the fit has not found yet, does not call the line away: no line of this power explains it.
TEST(LineTracker, AStrongToneThatNothingExplainsIsNotTheLine) {
  Signal window = window_with(line_at(0.2, kPower));
  window[static_cast<std::size_t>(std::lround(0.235 * kSamples))] = 3000.0;
  LineTracker tracker = tracker_at_first();
  watch(tracker, window, kNoMotion);
  EXPECT_NEAR(tracker.place().cycles, 0.2, kStep);
}

// What was taken for the line for a minute is forgotten when it has gone.
TEST(LineTracker, ForgetsATone) {
  LineTracker tracker = tracker_at_first();
  const Signal line = line_at(0.21, kPower);
  watch(tracker, window_with(line_at(0.18, kPower)), kNoMotion, 8.0);
  ASSERT_NEAR(tracker.place().cycles, 0.18, kStep);
  watch(tracker, window_with(line), kNoMotion, 8.0);
  EXPECT_NEAR(tracker.place().cycles, 0.21, kStep);
}

TEST(LineTracker, AnotherNoiseIsLookedForAnewAndTheSameIsNot) {
  LineTracker tracker = tracker_at_first();
  watch(tracker, window_with(line_at(0.215, kPower)), kNoMotion);
  const LinePlace known = tracker.place();
  tracker.believe(line(0.2, kPower));
  EXPECT_EQ(tracker.place().cycles, known.cycles);
  tracker.believe(line(0.202, 1.1 * kPower));  // learned a little more
  EXPECT_EQ(tracker.place().cycles, known.cycles);
  EXPECT_EQ(tracker.line(kOptions).power, 1.1 * kPower);
  tracker.believe(line(0.1, kPower));
  EXPECT_NEAR(tracker.place().cycles, 0.1, kStep);
  tracker.believe({});
  EXPECT_EQ(tracker.line(kOptions).power, 0.0);
}

// Above 0.4 cycles some places are beyond half a cycle, where there is nothing that could speak against the line.
TEST(LineTracker, StaysBelowHalfACycle) {
  LineTracker tracker;
  tracker.believe(line(0.49, kPower));
  watch(tracker, Signal(kBins, 1.0), kNoMotion, 400.0 * kShare);
  EXPECT_LT(tracker.place().cycles, 0.5);
  watch(tracker, window_with(line_at(0.47, kPower)), kNoMotion);
  EXPECT_NEAR(tracker.place().cycles, 0.47, 0.49 * 0.0125);
}

// A weak line that comes and goes, and moves all others by one, takes nothing from what is known of them.
TEST(LineTracker, ALineStaysWithWhoKnowsIt) {
  LineTrackers trackers;
  const SpectralLine strong = line(0.2, kPower);
  believe(std::array{strong}, trackers);
  watch(trackers[0], window_with(line_at(0.215, kPower)), kNoMotion);
  const double known = trackers[0].place().cycles;
  ASSERT_NEAR(known, 0.215, kStep);
  believe(std::array{line(0.1, 0.02), strong, line(0.4, 0.02)}, trackers);
  EXPECT_EQ(trackers[1].place().cycles, known);
  EXPECT_NEAR(trackers[0].place().cycles, 0.1, 0.1 * 0.0125);
  EXPECT_NEAR(trackers[2].place().cycles, 0.4, 0.4 * 0.0125);
  believe({}, trackers);
  believe(std::array{line(0.1, 0.02), strong}, trackers);
  EXPECT_EQ(trackers[1].place().cycles, known) << "it comes back";
  believe(std::array{strong}, trackers);
  EXPECT_EQ(trackers[0].place().cycles, known);
}

TEST(LineTracker, StaysFiniteWhateverItSees) {
  for (const double value : {0.0, 1e-300, 1e300, std::numeric_limits<double>::infinity()}) {
    LineTracker tracker = tracker_at_first();
    watch(tracker, Signal(kBins, value), kNoMotion, 1.0);
    EXPECT_TRUE(std::isfinite(tracker.place().cycles)) << value;
    EXPECT_GT(tracker.line(kOptions).mode.drive, 0.0) << value;
  }
}

// What stands out of a short window is as wide as its bins: it tells less of where the line is.
TEST(LineTracker, AShortWindowTellsLess) {
  const auto deviation_of = [](double samples) {
    const Signal window = window_with(line_at(0.21, kPower));
    const Signal rest(kBins, 1.0);
    LineTracker tracker = tracker_at_first();
    LineEvidence seen = evidence(window, rest, kNoMotion);
    seen.resolution = 1.0 / samples;
    for (int i = 0; i < 8; ++i) tracker.observe(seen, kOptions);
    return tracker.place().deviation;
  };
  EXPECT_GT(deviation_of(64.0), 1.2 * deviation_of(1024.0));
}

// Twice the half width, and a quarter of the frequency at the most, which is where the places end.
TEST(LineTracker, ALineReachesAsFarAsItsWidthAndItsPlaces) {
  const NoiseLine narrow{.cycles = 0.2, .half_width = 0.01, .power = 1.0};
  EXPECT_TRUE(narrow.reaches(0.219, kOptions));
  EXPECT_FALSE(narrow.reaches(0.221, kOptions));
  EXPECT_TRUE(narrow.reaches(0.181, kOptions));
  EXPECT_FALSE(narrow.reaches(0.179, kOptions));
  const NoiseLine broad{.cycles = 0.2, .half_width = 0.05, .power = 1.0};
  EXPECT_TRUE(broad.reaches(0.249, kOptions));
  EXPECT_FALSE(broad.reaches(0.251, kOptions));
}

// However far a line may wander in a window's time, no place gives away more than it has: where a window says nothing, they stay probabilities, and
// spread to what all places alike have, 0.25 / sqrt(3) of the frequency.
TEST(LineTracker, SpreadsNoFurtherThanAllOver) {
  LineOptions options;
  options.drift = 0.1;
  options.leak = 0.0;
  const Signal shaking(kBins, 1e9);
  const Signal rest(kBins, 1.0);
  LineTracker tracker = tracker_at_first();
  LineEvidence window = evidence(shaking, rest, shaking);
  window.share = 1.0;
  for (int i = 0; i < 2000; ++i) {
    tracker.observe(window, options);
    ASSERT_LT(tracker.place().deviation, 0.2 * 0.25 / std::sqrt(3.0) * 1.06) << i;
  }
  EXPECT_NEAR(tracker.place().deviation, 0.2 * 0.25 / std::sqrt(3.0), 0.06 * 0.03);
}

TEST(LineTracker, AllocatesNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const Signal window = window_with(line_at(0.21, kPower));
  const Signal rest(kBins, 1.0);
  const auto before = testing::allocations();
  LineTracker tracker = tracker_at_first();
  tracker.observe(evidence(window, rest, kNoMotion), kOptions);
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace gyrod::core
