#include "core/noise/rest_detector.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "core/noise/line_share.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;

/// Share of the samples, those of the first eleven blocks left out, at which the verdict was this.
double share_of(RestVerdict verdict, const Axes& axes, double sample_rate_hz) {
  RestDetector detector(sample_rate_hz);
  std::size_t n = 0;
  double seen = 0.0;
  double hits = 0.0;
  testing::run(detector, axes, [&] {
    if (++n <= 11 * detector.block_samples()) return;
    seen += 1.0;
    hits += detector.verdict() == verdict ? 1.0 : 0.0;
  });
  return hits / seen;
}

TEST(RestDetector, FindsWhiteNoiseAtRestAtAnyRate) {
  // The bounds are 7.5 and more standard deviations from each other: not one window in thousands fails.
  for (const double rate : {20.0, 100.0, 286.0, 1000.0}) {
    const auto size = static_cast<std::size_t>(std::max(300.0 * rate, 60'000.0));
    EXPECT_GT(share_of(RestVerdict::kRest, testing::still_axes(size, 0.3, 5), rate), 0.999) << rate;
  }
}

TEST(RestDetector, TakesEightBlocks) {
  RestDetector detector(200.0);
  const Axes axes = testing::still_axes(2000, 0.3, 1);
  std::size_t n = 0;
  std::size_t first = 0;
  testing::run(detector, axes, [&] {
    ++n;
    if (first == 0 && detector.verdict() == RestVerdict::kRest) first = n;
  });
  EXPECT_EQ(first, 1600U);
}

TEST(RestDetector, TakesSmoothlyFilteredNoiseForRest) {
  // A sensor's low-pass: the sum of neighbours, down to nothing at half the sample rate. Variances of blocks then differ by sqrt(3 / n)
  // and their means are twice as strong as white noise's: 6 of 7.5 and 4 of 8 remain.
  Axes axes = testing::still_axes(60'001, 0.1, 9);
  for (auto& axis : axes) {
    for (std::size_t n = 0; n < 60'000; ++n) axis[n] += axis[n + 1];
    axis.pop_back();
  }
  EXPECT_GT(share_of(RestVerdict::kRest, axes, 100.0), 0.98);
}

TEST(RestDetector, IsNotFooledByAnIdlingEngine) {
  // A car's parked 0708 recording: 31 Hz, 2.3 deg/s on y, over noise below 0.1 deg/s. Steady as rest is, but a line.
  Axes axes = testing::still_axes(60'000, 0.1, 3);
  testing::add_tone(axes, 1, 2.3 * std::numbers::sqrt2, 0.31);
  EXPECT_DOUBLE_EQ(share_of(RestVerdict::kTone, axes, 100.0), 1.0);
}

TEST(RestDetector, IsNotFooledByARoadOfSeveralLinesInTheNoise) {
  // The simulated drive's: five sines on each axis, a fifth of its power together, where one line may have two fifths.
  for (const double rate : {50.0, 100.0}) {
    Axes axes = testing::still_axes(static_cast<std::size_t>(600.0 * rate), 0.35, 3);
    const double amplitude = 0.35 * std::sqrt(2.0 * 0.25 / 5.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double hz : {6.3, 9.1, 12.7, 15.8, 19.2})
        testing::add_tone(axes, axis, amplitude, (hz + 0.4 * static_cast<double>(axis)) / rate);
    }
    EXPECT_LT(share_of(RestVerdict::kRest, axes, rate), 0.2) << rate;
  }
}

TEST(RestDetector, LooksThroughALineAndItsHarmonicThatAllAxesShare) {
  // A supply's: a quarter of each axis's power, and a tenth in the harmonic.
  for (const double rate : {100.0, 200.0, 400.0}) {
    Axes axes = testing::still_axes(static_cast<std::size_t>(300.0 * rate), 0.35, 3);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      testing::add_tone(axes, axis, 0.35 * std::sqrt(2.0 * 0.25 / 0.65), 20.0 / rate);
      testing::add_tone(axes, axis, 0.35 * std::sqrt(2.0 * 0.10 / 0.65), 40.0 / rate);
    }
    EXPECT_GT(share_of(RestVerdict::kRest, axes, rate), 0.85) << rate;
  }
}

TEST(RestDetector, LooksThroughTheLineOfASensor) {
  // An ADIS16405's z axis: a fifth of its variance is in a line at 20 Hz.
  Axes axes = testing::still_axes(60'000, 0.4, 3);
  testing::add_tone(axes, 2, 0.4 * std::sqrt(2.0 * 0.25), 0.197);
  EXPECT_GT(share_of(RestVerdict::kRest, axes, 100.0), 0.99);
}

TEST(RestDetector, SeesSlowMotionBelowTheNoise) {
  // A car that keeps its lane: 0.3 deg/s at 0.2 Hz under noise of 0.35 deg/s.
  Axes axes = testing::still_axes(60'000, 0.35, 3);
  testing::add_tone(axes, 2, 0.3, 0.002);
  EXPECT_LT(share_of(RestVerdict::kRest, axes, 100.0), 0.02);
}

TEST(RestDetector, EndsRestWithTheBlockInWhichMotionBegins) {
  RestDetector detector(100.0);
  Axes axes = testing::still_axes(2000, 0.35, 3);
  // Moves off after 15.5 s: yaw rises to 3 deg/s.
  for (std::size_t n = 1550; n < 2000; ++n)
    axes[2][n] += std::min(static_cast<double>(n - 1550) / 100.0, 1.0) * 3.0 * testing::kRadPerDeg;
  std::size_t n = 0;
  std::size_t last = 0;
  testing::run(detector, axes, [&] {
    ++n;
    if (detector.verdict() == RestVerdict::kRest) last = n;
  });
  EXPECT_EQ(last, 1599U) << "the block of 16 s ends it";
}

TEST(RestDetector, DropsTheSpectrumOfMotion) {
  RestDetector detector(100.0);
  Axes axes = testing::still_axes(4000, 0.35, 3);
  for (std::size_t n = 0; n < 2000; ++n)
    axes[0][n] += 20.0 * testing::kRadPerDeg * std::sin(0.05 * static_cast<double>(n));
  double most = 0.0;
  testing::run(detector, axes, [&] {
    if (detector.verdict() != RestVerdict::kRest || detector.fresh().count == 0.0) return;
    for (const double bin : detector.fresh().power[0]) most = std::max(most, bin / detector.fresh().count);
  });
  EXPECT_GT(most, 0.0);
  // Single bins of white noise exceed thirty times its variance once in 1e13.
  EXPECT_LT(most, 30.0 * 0.35 * 0.35 * testing::kRadPerDeg * testing::kRadPerDeg);
}

TEST(RestDetector, CallsASensorFrozenWhoseValuesNeverChange) {
  const Axes constant = {testing::Signal(3000, 0.1), testing::Signal(3000, 0.0), testing::Signal(3000, -0.2)};
  EXPECT_DOUBLE_EQ(share_of(RestVerdict::kFrozen, constant, 100.0), 1.0);
}

TEST(RestDetector, JudgesTheAxesThatAreThere) {
  Axes axes = testing::still_axes(6000, 0.35, 3);
  axes[0].assign(6000, 0.0);
  EXPECT_DOUBLE_EQ(share_of(RestVerdict::kRest, axes, 100.0), 1.0);
}

// The mean of eight times 0.1 is not 0.1 in floating point.
TEST(RestDetector, AnAxisThatNeverChangesIsNotMovingWhateverItsValue) {
  for (const double value : {0.1, -0.2, 0.37, 0.45, 1.0 / 3.0}) {
    Axes axes = testing::still_axes(3000, 0.35, 3);
    axes[0].assign(3000, value);
    EXPECT_DOUBLE_EQ(share_of(RestVerdict::kRest, axes, 100.0), 1.0) << value;
  }
}

TEST(RestDetector, UsesAnAccelerometerWhereThereIsOne) {
  const Axes rates = testing::still_axes(4000, 0.35, 3);
  const testing::Signal noise = testing::white_noise(4000, 77);
  for (const double shake : {0.0, 1.0}) {
    RestDetector detector(100.0);
    for (std::size_t n = 0; n < 4000; ++n) {
      const double t = static_cast<double>(n) / 100.0;
      // Rolls over a smooth road: 0.5 m/s^2 at 0.4 Hz, of which this gyro sees nothing.
      const Triple force = {0.02 * noise[n], 0.5 * shake * std::sin(2.0 * std::numbers::pi * 0.4 * t), 9.81};
      detector.step({rates[0][n], rates[1][n], rates[2][n]}, &force);
    }
    EXPECT_EQ(detector.verdict() == RestVerdict::kRest, shake == 0.0);
  }
}

TEST(RestDetector, TakesACoarseAccelerometersLastDigitForRest) {
  const Axes rates = testing::still_axes(4000, 0.35, 3);
  for (const double digit : {0.0098, 0.098}) {
    RestDetector detector(100.0);
    for (std::size_t n = 0; n < 4000; ++n) {
      // The last digit is set in every third block only: 1 mg, as cheap sensors have it, or ten times as much, which is motion.
      const bool set = n / 100 % 3 == 0 && n % 10 == 0;
      const Triple force = {set ? digit : 0.0, 0.0, 9.81};
      detector.step({rates[0][n], rates[1][n], rates[2][n]}, &force);
    }
    EXPECT_EQ(detector.verdict() == RestVerdict::kRest, digit < 0.02) << digit;
  }
}

TEST(RestDetector, StartsAgainWhereTheAccelerometerComesOrGoes) {
  RestDetector detector(100.0);
  const Axes rates = testing::still_axes(3000, 0.35, 3);
  const Triple level = {0.0, 0.0, 9.81};
  std::vector<std::size_t> begins;
  for (std::size_t n = 0; n < 3000; ++n) {
    const bool was = detector.verdict() == RestVerdict::kRest;
    detector.step({rates[0][n], rates[1][n], rates[2][n]}, n / 1000 == 1 ? &level : nullptr);
    if (!was && detector.verdict() == RestVerdict::kRest) begins.push_back(n);
  }
  EXPECT_EQ(begins, (std::vector<std::size_t>{799, 1799, 2799})) << "eight blocks after each change";
}

// Of two hundred samples of half the variance the level is 1 % off; of more, nobody has measured them.
TEST(RestDetector, LooksThroughABridgedSampleHereAndThereAndNotThroughMany) {
  const auto rest_where_one_is_bridged_every = [](std::size_t period) {
    Axes axes = testing::still_axes(6000, 0.35, 3);
    RestDetector detector(100.0);
    std::size_t at_rest = 0;
    for (std::size_t n = 1; n + 1 < 6000; ++n) {
      const bool bridged = n % period == 0;
      const auto at = [&](std::size_t axis) {
        return bridged ? 0.5 * (axes[axis][n - 1] + axes[axis][n + 1]) : axes[axis][n];
      };
      const Triple rate = {at(0), at(1), at(2)};
      bridged ? detector.bridge(rate) : detector.step(rate);
      at_rest += detector.verdict() == RestVerdict::kRest ? 1U : 0U;
    }
    return at_rest;
  };
  EXPECT_GT(rest_where_one_is_bridged_every(50), 5100U);
  EXPECT_EQ(rest_where_one_is_bridged_every(30), 0U);
}

TEST(RestDetector, StartsAgainAfterAGap) {
  RestDetector detector(100.0);
  const Axes axes = testing::still_axes(1500, 0.35, 3);
  testing::run(detector, axes, [] {});
  EXPECT_EQ(detector.verdict(), RestVerdict::kRest);
  detector.interrupt();
  EXPECT_EQ(detector.verdict(), RestVerdict::kTooEarly);
  Axes later = testing::still_axes(799, 0.35, 4);
  testing::add_rate(later, 0, 5.0);
  testing::run(detector, later, [&] { EXPECT_EQ(detector.verdict(), RestVerdict::kTooEarly); });
  detector.step({5.0 * testing::kRadPerDeg, 0.0, 0.0});
  EXPECT_EQ(detector.verdict(), RestVerdict::kRest) << "the other mean before the gap does not count";
}

TEST(LineShare, IsTheShareOfTheLine) {
  NoiseSpectrum power;
  power.fill(1.0);
  EXPECT_DOUBLE_EQ(line_shares(power).all, 0.0);
  // 253 bins of 1 and one of 103: what exceeds 2.5 is 100.5 of 356.
  power[100] = 103.0;
  EXPECT_NEAR(line_shares(power).all, 100.5 / 356.0, 1e-12);
  // A low-pass falling to a millionth has no line.
  for (std::size_t k = 0; k < power.size(); ++k)
    power[k] = std::pow(10.0, -6.0 * static_cast<double>(k) / 256.0);
  EXPECT_NEAR(line_shares(power).all, 0.0, 0.01);
  power.fill(0.0);
  EXPECT_DOUBLE_EQ(line_shares(power).all, 0.0);
}

TEST(LineShare, LeavesTheTwoStrongestOut) {
  NoiseSpectrum power;
  power.fill(1.0);
  power[200] = 903.0;
  power[100] = 103.0;
  // Six bins to either side of bin 100 are its own: a line that wanders.
  power[106] = 22.5;
  EXPECT_DOUBLE_EQ(line_shares(power).further, 0.0);
  power[107] = 42.5;
  EXPECT_NEAR(line_shares(power).further, 40.0 / (250.0 + 903.0 + 103.0 + 22.5 + 42.5), 1e-12);
  // At the slow end four.
  power.fill(1.0);
  power[5] = 103.0;
  power[9] = 22.5;
  power[30] = 52.5;
  EXPECT_DOUBLE_EQ(line_shares(power).further, 0.0);
  power[10] = 42.5;
  EXPECT_NEAR(line_shares(power).further, 40.0 / (250.0 + 103.0 + 22.5 + 52.5 + 42.5), 1e-12);
  power.fill(0.0);
  EXPECT_DOUBLE_EQ(line_shares(power).further, 0.0);
}

}  // namespace
}  // namespace gyrod::core
