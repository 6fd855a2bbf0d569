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
  options.motion_low = 2.0;
  options.motion_high = 6.0;
  for (const auto& [motion, moving] :
       {std::array{0.0, 0.0}, std::array{2.0, 0.0}, std::array{3.0, 0.25}, std::array{6.0, 1.0},
        std::array{50.0, 1.0}, std::array{core::SlowMotion::kUntold, 1.0}}) {
    SlowCorrection correction;
    const double paid = correction.apply(1.0, 0.0, Trust{.motion = motion}, options, JointScale{});
    EXPECT_NEAR(paid, kCorrection * (0.2 + 0.8 * moving), 1e-15) << motion;
  }
}

// 0.04 of the estimate's variance in parts of the noise's, where that is more than c; a tenth at the most.
TEST(SlowCorrection, IsFasterTheLessTheEstimateIsKnown) {
  JointOptions options = at_one_rate();
  options.correction_share = 0.04;
  for (const auto& [now, rate] : {std::array{0.25, kCorrection}, std::array{1.0, 0.04}, std::array{2.0, 0.08},
                                  std::array{10.0, 0.1}, std::array{1e300, 0.1}}) {
    SlowCorrection correction;
    EXPECT_NEAR(correction.apply(1.0, 0.0, Trust{.now = now}, options, JointScale{}), rate, 1e-15) << now;
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

/// An estimate that misses 1 all the time, expected to have the variance 0.25 where 0.2 is settled: by an equation of this power, up to 0.04.
void expect_power(double now, bool late, double factor, int power) {
  JointOptions options = at_one_rate();
  options.correction_rate = 0.0;
  (late ? options.late_steady_correction : options.steady_correction) = factor;
  options.most_steady_correction = late ? 0.03 : 0.04;
  options.most_late_steady_correction = late ? 0.04 : 0.03;
  options.steady_memory = 50.0;
  SlowCorrection correction;
  const std::array<double, 1> nothing{};
  double owed = 0.0;
  bool reached = false;
  for (int t = 1; t <= 400; ++t) {
    const double paid = correction.apply(1.0, 0.0, Trust{.now = now, .expected = 0.25, .settled = 0.2},
                                         options, JointScale{}, std::span(nothing).first(late ? 1 : 0));
    const double s = 0.2 * (1.0 - std::pow(1.0 - 1.0 / 50.0, t));
    const double b = 0.2 / 0.25 * std::max(1.0, now / 0.25);
    const double rate = std::min(factor * std::pow(s, power) * b, 0.04);
    ASSERT_NEAR(paid, rate * (owed + 1.0), 1e-9 * (1.0 + owed)) << t;
    owed += 1.0 - paid;
    reached = reached || rate == 0.04;
  }
  EXPECT_TRUE(reached) << "the limit was tested, too";
}

// s comes up to the settled ratio as 1 - (1 - 1/M)^t; b is 0.8 where members agree, and more where they do not.
TEST(SlowCorrection, FollowsTheThirdPowerAndWithLookAheadTheFourth) {
  for (const double now : {0.1, 0.25, 0.4}) {
    expect_power(now, false, 8.0, 3);
    expect_power(now, true, 40.0, 4);
  }
}

/// Nothing but what is given back where the estimate has trusted the samples for long, at the most there is: 0.04 a sample.
JointOptions at_most_steady() {
  JointOptions options = at_one_rate();
  options.correction_rate = 0.0;
  options.steady_memory = 4.0;
  options.steady_correction = options.late_steady_correction = 1e12;
  options.most_steady_correction = options.most_late_steady_correction = 0.04;
  return options;
}

// Where the estimate has trusted the samples for long, but nothing slow moves, there is nothing to give back.
TEST(SlowCorrection, GivesBackNothingWhereNothingSlowMoves) {
  JointOptions options = at_most_steady();
  options.motion_low = 2.0;
  options.motion_high = 10.0;
  options.motion_steady = 4.0;
  const std::array<double, 1> nothing{};
  for (const auto& [motion, part] : {std::array{0.0, 0.0}, std::array{2.0, 0.0}, std::array{2.5, 0.25},
                                     std::array{4.0, 1.0}, std::array{50.0, 1.0}}) {
    for (const std::size_t newer : {0U, 1U}) {
      SlowCorrection correction;
      const Trust trust{.now = 0.2, .expected = 0.2, .settled = 0.2, .motion = motion};
      const double paid =
          correction.apply(1.0, 0.0, trust, options, JointScale{}, std::span(nothing).first(newer));
      EXPECT_NEAR(paid, 0.04 * part, 1e-15) << motion << ", " << newer;
    }
  }
}

// At four times the design's sample rate a quarter in each sample: 0.01 for 0.04, 0.025 for 0.1 at the most.
TEST(SlowCorrection, IsNoFasterInASecondWhereSamplesComeFaster) {
  JointOptions options = at_one_rate();
  options.correction_share = 0.04;
  for (const auto& [now, rate] : {std::array{1.0, 0.01}, std::array{2.0, 0.02}, std::array{1e300, 0.025}}) {
    SlowCorrection correction;
    EXPECT_NEAR(correction.apply(1.0, 0.0, Trust{.now = now}, options, JointScale(480.0, 1024)), rate, 1e-15)
        << now;
  }
}

// The most that is given back is a part of what is owed in a time, not in a sample.
TEST(SlowCorrection, GivesBackNoMoreInASecondWhereSamplesComeFaster) {
  const JointOptions options = at_most_steady();
  const std::array<double, 1> nothing{};
  for (const std::size_t newer : {0U, 1U}) {
    SlowCorrection correction;
    const Trust trust{.now = 0.2, .expected = 0.2, .settled = 0.2};
    const double paid =
        correction.apply(1.0, 0.0, trust, options, JointScale(480.0, 1024), std::span(nothing).first(newer));
    EXPECT_NEAR(paid, 0.01, 1e-15) << newer;
  }
}

}  // namespace
}  // namespace gyrod
