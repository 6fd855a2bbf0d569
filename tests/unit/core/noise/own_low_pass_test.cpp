#include "core/noise/own_low_pass.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include "core/evaluation/butterworth.hpp"
#include "core/noise/rest_detector.hpp"
#include "core/noise/standstill_learner.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;

struct Filter {
  std::size_t order = 2;
  double cutoff = 0.05;  ///< cycles per sample
};

void low_pass(testing::Signal& x, const Filter& filter) {
  filter_forward(butterworth(filter.order, filter.cutoff), x);
}

/// Noise of 0.3 deg/s behind the same filter on each axis.
Axes filtered(std::size_t size, const Filter& filter, unsigned seed) {
  Axes axes = testing::still_axes(size, 0.3, seed);
  for (auto& axis : axes) low_pass(axis, filter);
  return axes;
}

struct Moments {
  double independent = 0.0;
  double slow = 0.0;
};

/// By their definitions from |H|^2 = 1 / (1 + (tan(pi f) / tan(pi fc))^(2 order)), 100 000 steps.
Moments moments_of(const Filter& filter) {
  constexpr std::size_t kSteps = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < kSteps; ++k) {
    const double f = 0.5 * (static_cast<double>(k) + 0.5) / kSteps;
    const double ratio = std::tan(std::numbers::pi * f) / std::tan(std::numbers::pi * filter.cutoff);
    const double power = 1.0 / (1.0 + std::pow(ratio, 2.0 * static_cast<double>(filter.order)));
    sum += power / kSteps;
    squares += power * power / kSteps;
  }
  return {sum * sum / squares, 1.0 / sum};
}

/// Means over a run of what is said at the end of each segment, and the share of them at which something was said.
struct Said {
  double independent = 0.0;
  double slow = 0.0;
  double share = 0.0;
};

Said said_of(const Axes& axes, double rate_hz = 200.0) {
  OwnLowPass low_pass(rate_hz);
  Periodogram periodogram(kNoiseSegment);
  Said said;
  double count = 0.0;
  double told = 0.0;
  for (std::size_t n = 0; n < axes[0].size(); ++n) {
    low_pass.step({axes[0][n], axes[1][n], axes[2][n]}, periodogram);
    if (n % 256 != 255 || n < 3072) continue;
    count += 1.0;
    if (low_pass.independent() == 1.0) continue;
    told += 1.0;
    said.independent += low_pass.independent();
    said.slow += low_pass.slow();
  }
  said.share = told / count;
  said.independent /= std::max(told, 1.0);
  said.slow /= std::max(told, 1.0);
  return said;
}

TEST(OwnLowPass, TellsHowMuchOfTheNoiseIsNewAndHowMuchIsSlow) {
  for (const Filter& filter :
       {Filter{1, 0.1}, Filter{1, 0.05}, Filter{2, 0.15}, Filter{2, 0.1}, Filter{2, 0.05}, Filter{2, 0.025},
        Filter{4, 0.15}, Filter{4, 0.05}, Filter{4, 0.025}}) {
    const Said said = said_of(filtered(400'000, filter, 3));
    const Moments expected = moments_of(filter);
    SCOPED_TRACE(::testing::Message() << "order " << filter.order << ", " << filter.cutoff);
    EXPECT_GT(said.share, 0.99);
    // Bands that are a quarter wide cut corners, most at a cut-off of thirteen bins; the flat part of order 1 is no plateau: 18 %.
    EXPECT_NEAR(said.independent / expected.independent, 1.0, 0.2);
    EXPECT_NEAR(said.slow / expected.slow, 1.0, 0.2);
  }
}

TEST(OwnLowPass, SaysNothingOfNoiseThatIsWide) {
  for (const double level : {1e-6, 0.3}) {
    const Said white = said_of(testing::still_axes(400'000, level, 7));
    EXPECT_DOUBLE_EQ(white.share, 0.0);
  }
  EXPECT_DOUBLE_EQ(said_of(filtered(400'000, {1, 0.2}, 7)).share, 0.0) << "0.59 of the bins";
}

TEST(OwnLowPass, LooksThroughTheLineOfAnAxis) {
  Axes axes = filtered(400'000, {2, 0.05}, 5);
  // A third of that axis's power.
  testing::add_tone(axes, 2, 0.3 * std::sqrt(2.0 * 0.5 / moments_of({2, 0.05}).slow), 0.031);
  const Said said = said_of(axes);
  EXPECT_GT(said.share, 0.95);
  EXPECT_NEAR(said.independent / moments_of({2, 0.05}).independent, 1.0, 0.15);
}

TEST(OwnLowPass, AsksForTheSameFilterOnAllAxes) {
  Axes axes = testing::still_axes(400'000, 0.3, 5);
  low_pass(axes[0], {2, 0.1});
  low_pass(axes[1], {2, 0.05});
  low_pass(axes[2], {2, 0.025});
  EXPECT_LT(said_of(axes).share, 0.02);
}

// A road: half of the power in a hump an octave wide that the rest does not have.
TEST(OwnLowPass, AsksForAShapeWithoutHumps) {
  Axes axes = filtered(400'000, {2, 0.1}, 5);
  constexpr std::array<double, 2> kHump = {2.0 * 0.97 * 0.951, -0.97 * 0.97};  // 0.05 cycles per sample
  for (unsigned a = 0; a < 3; ++a)
    axes[a] = testing::sum(axes[a], testing::autoregressive(kHump, axes[a].size(), 50 + a), 3e-4);
  EXPECT_LT(said_of(axes).share, 0.02);
}

// A hand: ever stronger towards slow, without a flat part. First-order, 0.002 cycles per sample: below the lowest band.
TEST(OwnLowPass, AsksForAFlatPart) { EXPECT_LT(said_of(filtered(400'000, {1, 0.002}, 5)).share, 0.1); }

TEST(OwnLowPass, JudgesTwoAxesButNotOne) {
  Axes axes = filtered(100'000, {2, 0.05}, 5);
  axes[0].assign(axes[0].size(), 0.1);
  EXPECT_GT(said_of(axes).share, 0.9);
  axes[1].assign(axes[1].size(), -0.2);
  EXPECT_DOUBLE_EQ(said_of(axes).share, 0.0);
}

TEST(OwnLowPass, ForgetsAtAGapAndWhenTheNoiseGetsWide) {
  OwnLowPass low_pass(200.0);
  Periodogram periodogram(kNoiseSegment);
  const auto run = [&](const Axes& axes) {
    for (std::size_t n = 0; n < axes[0].size(); ++n)
      low_pass.step({axes[0][n], axes[1][n], axes[2][n]}, periodogram);
  };
  const Axes narrow = filtered(6000, {2, 0.05}, 5);
  run(narrow);
  EXPECT_LT(low_pass.independent(), 0.5);
  low_pass.interrupt();
  EXPECT_EQ(low_pass.independent(), 1.0);
  EXPECT_EQ(low_pass.slow(), 1.0);
  run(narrow);
  EXPECT_LT(low_pass.independent(), 0.5);
  run(testing::still_axes(4096, 0.3, 5));
  EXPECT_EQ(low_pass.independent(), 1.0) << "eight segments, and all of them wide";
}

/// Parts of the samples after the first minute at which the verdict is rest.
double at_rest(const Axes& axes, double rate_hz, const Axes* forces = nullptr) {
  RestDetector detector(rate_hz);
  double seen = 0.0;
  double rest = 0.0;
  for (std::size_t n = 0; n < axes[0].size(); ++n) {
    const Triple force =
        forces == nullptr ? Triple{} : Triple{(*forces)[0][n], (*forces)[1][n], (*forces)[2][n]};
    detector.step({axes[0][n], axes[1][n], axes[2][n]}, forces == nullptr ? nullptr : &force);
    if (static_cast<double>(n) < 60.0 * rate_hz) continue;
    seen += 1.0;
    rest += detector.verdict() == RestVerdict::kRest ? 1.0 : 0.0;
  }
  return rest / seen;
}

TEST(OwnLowPass, LetsRestBeFoundBehindIt) {
  // Cut-offs from a third to a twentieth of half the rate: 42 Hz of 400 and 1000, 10 Hz of 200, 5 Hz of 100.
  for (const auto& [rate_hz, cutoff_hz] :
       {std::array{1000.0, 42.0}, std::array{400.0, 42.0}, std::array{200.0, 30.0}, std::array{200.0, 10.0},
        std::array{100.0, 5.0}, std::array{100.0, 2.5}}) {
    const auto size = static_cast<std::size_t>(400.0 * rate_hz);
    EXPECT_GT(at_rest(filtered(size, {2, cutoff_hz / rate_hz}, 11), rate_hz), 0.97) << rate_hz;
  }
}

// Blocks are long behind a low-pass of 5 Hz, and as short as ever once the noise is wide, with a gap or without.
TEST(OwnLowPass, IsForgottenByRestToo) {
  for (const bool gap : {true, false}) {
    RestDetector detector(100.0);
    testing::run(detector, filtered(12'000, {2, 0.05}, 11), [] {});
    EXPECT_EQ(detector.block_samples(), 400U);
    if (gap) detector.interrupt();
    std::size_t n = 0;
    std::size_t first = 0;
    testing::run(detector, testing::still_axes(6000, 0.1, 12), [&] {
      ++n;
      if (first == 0 && n > 400 && detector.verdict() == RestVerdict::kRest) first = n;
    });
    EXPECT_EQ(detector.block_samples(), 100U);
    EXPECT_LE(first, gap ? 800U : 3000U) << "eight blocks, and the spectra that have to tell before";
    EXPECT_GT(first, 0U);
  }
}

// A shaken accelerometer, 2.3 times as loud every other five seconds, with so few effective samples that no level would be uneven of them.
TEST(OwnLowPass, LeavesALevelThatChangesVisibleBehindIt) {
  const Axes axes = testing::still_axes(40'000, 0.1, 11);
  Axes forces;
  for (unsigned a = 0; a < 3; ++a) {
    forces[a] = testing::white_noise(axes[a].size(), 50 + a);
    low_pass(forces[a], {2, 0.0175});
    for (std::size_t n = 0; n < forces[a].size(); ++n) forces[a][n] *= n / 500 % 2 == 1 ? 0.23 : 0.1;
  }
  EXPECT_LT(at_rest(axes, 100.0, &forces), 0.05);
}

TEST(OwnLowPass, LetsAnAccelerometerBehindItBeAtRest) {
  const Axes axes = filtered(80'000, {2, 0.05}, 11);
  Axes forces = filtered(80'000, {2, 0.05}, 12);
  for (auto& force : forces) force = testing::times(force, 40.0);  // 0.06 m/s^2 behind the filter
  EXPECT_GT(at_rest(axes, 200.0, &forces), 0.97);
}

TEST(OwnLowPass, LeavesSlowMotionVisibleBehindIt) {
  // 0.2 deg/s at 0.2 Hz under noise of 0.1 deg/s behind the filter.
  Axes axes = filtered(80'000, {2, 0.05}, 11);
  testing::add_tone(axes, 2, 0.2, 0.001);
  EXPECT_LT(at_rest(axes, 200.0), 0.02);
}

// Bilinear Butterworth of second order: sum |H|^2 over f gives the share of the variance that is left.
TEST(OwnLowPass, LetsTheNoiseBehindItBeLearned) {
  StandstillLearner learner(200.0);
  const Filter filter{2, 0.05};
  testing::run(learner, filtered(24'000, filter, 11), [] {});
  for (const NoiseModel& model : learner.models()) {
    ASSERT_TRUE(is_usable(model));
    const double deviation = 0.3 * testing::kRadPerDeg / std::sqrt(moments_of(filter).slow);
    EXPECT_NEAR(std::sqrt(noise_variance(model)) / deviation, 1.0, 0.05);
  }
}

}  // namespace
}  // namespace gyrod::core
