// What an answer is given where slow motion comes out too small, apart from any filter.
#include "core/joint/gain_correction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

#include "unit/core/joint/swing_support.hpp"

namespace gyrod {
namespace {

using core::GainCorrection;
using core::JointOptions;
using core::JointScale;
using testing::low_pass;
using testing::share_in_phase;
using testing::swing;

/// Long enough for all that is learned: e^-12.
constexpr int kSettled = 12 * 4096;

/// Of an answer that is `gain` times the swing, with the swing as samples.
struct Swinging {
  GainCorrection correction{};
  JointOptions options{};
  double gain = 0.94;
  double noise_variance = 0.0;
  int n = 0;

  /// @return what was added
  double step() {
    const double x = swing(n++);
    static_cast<void>(correction.apply(x, gain * x, noise_variance, options, JointScale{}));
    return correction.paid();
  }
  void settle() {
    while (n < kSettled) step();
  }
  /// What is added in parts of the answer: of its component in phase.
  double share() {
    settle();
    return share_in_phase(
        n, [this](int k) { return gain * swing(k); }, [this](int) { return step(); });
  }
};

/// What is added per unit of k. A and C are of the same filters, so that C / A is (1 - W) / W exactly.
double follows() {
  const JointOptions options;
  return ((1.0 - low_pass(options.gain_mean)) * low_pass(options.gain_follow)).real();
}

TEST(GainCorrection, GivesASwingTheSizeThatTheSamplesSay) {
  Swinging swinging;
  EXPECT_NEAR(swinging.share(), (1.0 - 0.94) / 0.94 * follows(), 1e-6);
  EXPECT_NEAR(0.94 * (1.0 + swinging.share()), 1.0, 0.005);
}

TEST(GainCorrection, TakesAwayNothingWhereTheAnswerIsTooLarge) {
  Swinging swinging{.gain = 1.05};
  EXPECT_EQ(swinging.share(), 0.0);
}

// 0.45 is as far above the most, 0.3, as 0.15 is below it; from 0.6 on it is noise that the answer has left.
TEST(GainCorrection, IsLessSureTheMoreIsMissing) {
  Swinging much{.gain = 1.0 / 1.45};
  EXPECT_NEAR(much.share(), 0.15 * follows(), 1e-6);
  Swinging most{.gain = 1.0 / 1.3};
  EXPECT_NEAR(most.share(), 0.3 * follows(), 1e-6);
  Swinging noise{.gain = 0.6};
  EXPECT_EQ(noise.share(), 0.0);
}

// With noise of variance R the share is A / (A + ridge R) of that without: 1 / ratio - 1 grows as R.
TEST(GainCorrection, IsLessSureTheMoreNoiseThereIs) {
  const auto excess = [](double noise_variance) {
    Swinging without;
    Swinging with{.noise_variance = noise_variance};
    return without.share() / with.share() - 1.0;
  };
  // A: the swing's mean square, but for its ripple, behind the mean's and the band's filters.
  const JointOptions options;
  const double amplitude =
      0.94 * std::abs(1.0 - low_pass(options.gain_mean)) * std::pow(std::abs(low_pass(options.gain_band)), 2);
  const double power = 0.5 * amplitude * amplitude;
  EXPECT_NEAR(excess(1.0), options.gain_ridge / power, 5e-3 * options.gain_ridge / power);
  EXPECT_NEAR(excess(10.0), 10.0 * excess(1.0), 1e-2 * excess(10.0));
}

TEST(GainCorrection, LeavesAConstantAsItIs) {
  GainCorrection correction;
  for (int n = 0; n < 1000; ++n)
    EXPECT_EQ(correction.apply(5.0, 4.7, 0.1, JointOptions{}, JointScale{}), 4.7);
}

// After small motion a turn of a hundred times its size comes, which the answer follows: what is added stays below most_gain times gain_clip standard
// deviations of slow motion, to which the turn itself adds as it is learned.
TEST(GainCorrection, AddsNextToNothingToATurn) {
  Swinging swinging;
  swinging.settle();
  const int begin = swinging.n;
  double most = 0.0;
  for (int n = begin; n < begin + 1200; ++n) {
    const double turn = 100.0 * std::min((n - begin) / 36.0, 1.0);
    const double answer = 0.94 * swing(n) + turn;
    static_cast<void>(
        swinging.correction.apply(swing(n) + turn, answer, 0.0, swinging.options, JointScale{}));
    most = std::max(most, std::abs(swinging.correction.paid()));
  }
  EXPECT_LT(most, 0.005 * 100.0);
  EXPECT_GT(most, 0.0);
}

TEST(GainCorrection, KeepsItsTimesInSeconds) {
  for (const double rate_hz : {480.0, 60.0}) {
    JointOptions here;
    for (double* samples : {&here.gain_band, &here.gain_follow, &here.gain_mean, &here.gain_memory})
      *samples *= rate_hz / core::kDesignRateHz;
    GainCorrection scaled;
    GainCorrection expected;
    for (int n = 0; n < 2000; ++n) {
      EXPECT_EQ(scaled.apply(swing(n), 0.94 * swing(n), 1.0, JointOptions{}, JointScale(rate_hz, 1024)),
                expected.apply(swing(n), 0.94 * swing(n), 1.0, here, JointScale{}));
    }
    EXPECT_NE(scaled.paid(), 0.0);
  }
}

// What leaves the numbers is forgotten, and the correction begins anew.
TEST(GainCorrection, IsFiniteAndGoesOnAfterTheLargestNumbers) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Swinging swinging;
  swinging.settle();
  for (int n = 0; n < 100; ++n) {
    const double huge = n % 2 == 0 ? kLargest : -kLargest;
    EXPECT_EQ(swinging.correction.apply(huge, 0.5 * huge, 0.1, swinging.options, JointScale{}), 0.5 * huge);
  }
  swinging.n = 0;
  EXPECT_NEAR(swinging.share(), (1.0 - 0.94) / 0.94 * follows(), 1e-4);
}

}  // namespace
}  // namespace gyrod
