// What an estimate is given back of slow motion, apart from any filter.
#include "core/joint/slow_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include <gtest/gtest.h>

namespace gyrod {
namespace {

using core::JointOptions;
using core::JointScale;
using core::SlowCorrection;
using core::Trust;

constexpr double kCorrection = 0.02;
constexpr double kWeight = 0.75;
constexpr double kDecay = 3.0;
constexpr std::size_t kAhead = 16;

/// One rate, whatever the estimate's variance is.
JointOptions at_one_rate() {
  JointOptions options;
  options.correction_rate = kCorrection;
  options.correction_share = 0.0;
  options.steady_correction = options.late_steady_correction = 0.0;
  options.residual_weight = kWeight;
  options.residual_decay = kDecay;
  return options;
}

/// What an estimate misses of a step at 0.
double step_at(int n) { return n >= 0 ? 1.0 : 0.0; }

/// What it misses at n + 1, n + 2, ...
template <class Missed>
std::array<double, kAhead> after(int n, const Missed& missed) {
  std::array<double, kAhead> newer{};
  for (std::size_t k = 0; k < kAhead; ++k) newer[k] = missed(n + static_cast<int>(k) + 1);
  return newer;
}

double half_delay(bool look_ahead) {
  SlowCorrection correction;
  for (int n = -100; n < 200; ++n) {
    const auto newer = after(n, step_at);
    const double paid = correction.apply(step_at(n), 0.0, Trust{}, at_one_rate(), JointScale{},
                                         std::span(newer).first(look_ahead ? kAhead : 0));
    if (paid >= 0.5) return n;
  }
  return 1e9;
}

// The estimate misses a step at n = 0. With h the impulse response c (1 - c)^m of a correction that does not look ahead, and B = 1 - 3 c,
//   paid[n] = sum_(m <= n) h[m] + 0.75 sum_(k <= L) B^k h[n + k].
TEST(SlowCorrection, GivesBackAStepAsItsDifferenceEquationSays) {
  SlowCorrection correction;
  const auto h = [](int m) { return m < 0 ? 0.0 : kCorrection * std::pow(1.0 - kCorrection, m); };
  const double kept = 1.0 - kDecay * kCorrection;
  for (int n = -40; n < 400; ++n) {
    const double paid =
        correction.apply(step_at(n), 0.0, Trust{}, at_one_rate(), JointScale{}, after(n, step_at));
    double expected = n < 0 ? 0.0 : 1.0 - std::pow(1.0 - kCorrection, n + 1);
    for (int k = 1; k <= static_cast<int>(kAhead); ++k) expected += kWeight * std::pow(kept, k) * h(n + k);
    ASSERT_NEAR(paid, expected, 1e-12) << n;
    ASSERT_EQ(paid, correction.paid());
  }
}

// By L samples where all newer residuals counted in full; by less, as they fade.
TEST(SlowCorrection, IsEarlierWhereItLooksAhead) {
  const double earlier = half_delay(false) - half_delay(true);
  EXPECT_GE(earlier, 4.0);
  EXPECT_LE(earlier, static_cast<double>(kAhead));
}

// From c where all moves down to the part that is left of it where nothing does.
TEST(SlowCorrection, IsSlowerWhereNothingSlowMoves) {
  JointOptions options = at_one_rate();
  options.still_correction = 0.2;
  for (const double moving : {0.0, 0.25, 1.0}) {
    SlowCorrection correction;
    const double paid = correction.apply(1.0, 0.0, Trust{.moving = moving}, options, JointScale{});
    EXPECT_NEAR(paid, kCorrection * (0.2 + 0.8 * moving), 1e-15) << moving;
  }
}

// What is paid early is paid once: in the end the answers have the samples' sum.
TEST(SlowCorrection, KeepsTheSumOfTheSamples) {
  SlowCorrection correction;
  const auto missed = [](int n) { return n >= 500 && n < 700 ? 1.0 : 0.0; };
  double owed = 0.0;
  for (int n = 0; n < 3000; ++n) {
    owed +=
        missed(n) - correction.apply(missed(n), 0.0, Trust{}, at_one_rate(), JointScale{}, after(n, missed));
  }
  EXPECT_NEAR(owed, 0.0, 1e-12);
}

// s comes up to the settled ratio as 1 - (1 - 1/M)^t. Here b = 0.2 / 0.25 = 0.8.
TEST(SlowCorrection, WithLookAheadFollowsTheFourthPower) {
  JointOptions options = at_one_rate();
  options.correction_rate = 0.0;
  options.late_steady_correction = 40.0;
  options.most_late_steady_correction = 0.05;
  options.steady_memory = 50.0;
  SlowCorrection correction;
  const std::array<double, 1> nothing{};
  double owed = 0.0;
  bool reached = false;
  for (int t = 1; t <= 400; ++t) {
    const double paid = correction.apply(1.0, 0.0, Trust{.now = 0.25, .expected = 0.25, .settled = 0.2},
                                         options, JointScale{}, nothing);
    const double s = 0.2 * (1.0 - std::pow(1.0 - 1.0 / 50.0, t));
    const double rate = std::min(40.0 * s * s * s * s * 0.8, 0.05);
    ASSERT_NEAR(paid, rate * (owed + 1.0), 1e-9 * (1.0 + owed)) << t;
    owed += 1.0 - paid;
    reached = reached || rate == 0.05;
  }
  EXPECT_TRUE(reached) << "the limit was tested, too";
}

}  // namespace
}  // namespace gyrod
