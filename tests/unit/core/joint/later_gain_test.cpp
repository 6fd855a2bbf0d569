// What answers at once learn of their size from later ones, apart from any filter.
#include "core/joint/later_gain.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "unit/core/joint/swing_support.hpp"

namespace gyrod {
namespace {

using core::JointOptions;
using core::JointScale;
using core::LaterGain;
using testing::kSwingPeriod;
using testing::low_pass;
using testing::share_in_phase;
using testing::swing;

/// Long enough for all that is learned: e^-12.
constexpr int kSettled = 12 * 2048;

/// Of answers at once that are `gain` times the swing, `late` samples after it, with the swing as later answers.
struct Swinging {
  LaterGain correction{};
  JointOptions options{};
  double gain = 0.94;
  double late = 0.0;
  double noise_variance = 0.0;
  int n = 0;

  /// @return what was added
  double step() {
    const double at_once = gain * swing(n - late);
    const double answer = correction.apply(at_once, noise_variance, options, JointScale{});
    correction.compare(swing(n), at_once, options, JointScale{});
    ++n;
    return answer - at_once;
  }
  /// What is added in parts of the answer: of its component in phase.
  double share() {
    while (n < kSettled) step();
    return share_in_phase(
        n, [this](int k) { return gain * swing(k - late); }, [this](int) { return step(); });
  }
};

/// What is added per unit of k. A and C are of the same filters, so that C / A is what is lacking exactly.
double follows() {
  const JointOptions options;
  return ((1.0 - low_pass(options.gain_mean)) * low_pass(options.later_follow)).real();
}

TEST(LaterGain, GivesASwingTheSizeThatLaterAnswersHave) {
  Swinging swinging;
  EXPECT_NEAR(swinging.share(), 0.06 * follows(), 1e-6);
  EXPECT_GT(0.94 * (1.0 + swinging.share()), 0.99);
}

TEST(LaterGain, TakesAwayWhatIsTooMuch) {
  Swinging swinging{.gain = 1.03};
  EXPECT_NEAR(swinging.share(), -0.03 * follows(), 1e-6);
}

// Lateness d makes the part in phase cos(2 pi d / period) of the swing. The other part, five times as large, leaves a ripple in what is learned: 1 in 2048
// times the 2 * 2 pi / 240 that it turns by in a sample, 5 % of what is lacking.
TEST(LaterGain, MakesUpForWhatLatenessTakesOfTheSize) {
  Swinging swinging{.gain = 1.0, .late = 15.0};
  const double expected = (1.0 - std::cos(2.0 * std::numbers::pi * 15.0 / kSwingPeriod)) * follows();
  EXPECT_NEAR(swinging.share(), expected, 0.05 * expected);
}

TEST(LaterGain, GivesAndTakesSoMuchAtTheMost) {
  Swinging small{.gain = 0.5};
  EXPECT_NEAR(small.share(), JointOptions{}.most_later_gain * follows(), 1e-6);
  Swinging large{.gain = 1.5};
  EXPECT_NEAR(large.share(), -JointOptions{}.most_later_loss * follows(), 1e-6);
}

// With noise of variance R the share is A / (A + ridge R) of that without: 1 / ratio - 1 grows as R.
TEST(LaterGain, IsLessSureTheMoreNoiseThereIs) {
  const auto excess = [](double noise_variance) {
    Swinging without;
    Swinging with{.noise_variance = noise_variance};
    return without.share() / with.share() - 1.0;
  };
  // A: the swing's mean square, but for its ripple, behind the mean's and the band's filters.
  const JointOptions options;
  const double amplitude =
      std::abs(1.0 - low_pass(options.gain_mean)) * std::pow(std::abs(low_pass(options.gain_band)), 2);
  const double power = 0.5 * amplitude * amplitude;
  EXPECT_NEAR(excess(1.0), options.gain_ridge / power, 5e-3 * options.gain_ridge / power);
  EXPECT_NEAR(excess(10.0), 10.0 * excess(1.0), 1e-2 * excess(10.0));
}

TEST(LaterGain, LeavesAConstantAsItIs) {
  LaterGain correction;
  for (int n = 0; n < 1000; ++n) {
    EXPECT_EQ(correction.apply(4.7, 0.1, JointOptions{}, JointScale{}), 4.7);
    correction.compare(5.0, 4.7, JointOptions{}, JointScale{});
  }
}

// After small motion a turn of a hundred times its size comes, which both answers follow: what is added stays below most_later_gain times gain_clip
// standard deviations of slow motion, to which the turn itself adds as it is learned.
TEST(LaterGain, AddsNextToNothingToATurn) {
  Swinging swinging;
  swinging.share();
  double most = 0.0;
  const int begin = swinging.n;
  for (int n = begin; n < begin + 1200; ++n) {
    const double turn = 100.0 * std::min((n - begin) / 36.0, 1.0);
    const double at_once = 0.94 * swing(n) + turn;
    const double answer = swinging.correction.apply(at_once, 0.0, swinging.options, JointScale{});
    swinging.correction.compare(swing(n) + turn, at_once, swinging.options, JointScale{});
    most = std::max(most, std::abs(answer - at_once));
  }
  EXPECT_LT(most, 0.005 * 100.0);
  EXPECT_GT(most, 0.0);
}

TEST(LaterGain, KeepsItsTimesInSeconds) {
  for (const double rate_hz : {480.0, 60.0}) {
    JointOptions here;
    for (double* samples : {&here.gain_band, &here.later_follow, &here.gain_mean, &here.later_memory})
      *samples *= rate_hz / core::kDesignRateHz;
    const JointScale scale(rate_hz, 1024);
    LaterGain scaled;
    LaterGain expected;
    double added = 0.0;
    for (int n = 0; n < 2000; ++n) {
      const double at_once = 0.94 * swing(n);
      const double answer = scaled.apply(at_once, 1.0, JointOptions{}, scale);
      EXPECT_EQ(answer, expected.apply(at_once, 1.0, here, JointScale{}));
      scaled.compare(swing(n), at_once, JointOptions{}, scale);
      expected.compare(swing(n), at_once, here, JointScale{});
      added = std::max(added, std::abs(answer - at_once));
    }
    EXPECT_GT(added, 0.0);
  }
}

// What leaves the numbers is forgotten, and the correction begins anew.
TEST(LaterGain, IsFiniteAndGoesOnAfterTheLargestNumbers) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  Swinging swinging;
  swinging.share();
  for (int n = 0; n < 100; ++n) {
    const double huge = n % 2 == 0 ? kLargest : -kLargest;
    EXPECT_TRUE(std::isfinite(swinging.correction.apply(0.5 * huge, 0.1, swinging.options, JointScale{})));
    swinging.correction.compare(huge, 0.5 * huge, swinging.options, JointScale{});
  }
  swinging.n = 0;
  EXPECT_NEAR(swinging.share(), 0.06 * follows(), 1e-4);
}

}  // namespace
}  // namespace gyrod
