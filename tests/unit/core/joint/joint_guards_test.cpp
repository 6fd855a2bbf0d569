// What a user of the two-speed estimator relies on, on simulated noise: steps and turns come through, rest is quiet, sums stay.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/evaluation/tuning.hpp"
#include "core/evaluation/turns.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/noise/noise_model.hpp"
#include "joint_support.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using testing::JointOutput;
using testing::Signal;

/// An ADIS16405's, deg/s at 100 Hz.
constexpr double kNoise = 0.35;
constexpr std::size_t kRate = 100;
constexpr std::size_t kLag = 16;

JointOutput run(const Signal& z) {
  return testing::run_joint(z, core::scaled(core::white_noise(kNoise * kNoise), 1.02), kLag);
}

/// Samples until the mean response of `runs` stretches of noise has 90 % of the step. The response is what the step changes, so that
/// the noise cancels.
std::optional<std::size_t> samples_to_90(double step, std::size_t hold, bool realtime) {
  constexpr std::size_t kStraight = 2048;
  constexpr unsigned kRuns = 3;
  Signal response(hold, 0.0);
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const Signal without = testing::times(testing::white_noise(kStraight + hold + kLag, seed), kNoise);
    Signal with = without;
    for (std::size_t t = kStraight; t < with.size(); ++t) with[t] += step;
    const JointOutput before = run(without);
    const JointOutput after = run(with);
    const Signal& a = realtime ? after.realtime : after.denoised;
    const Signal& b = realtime ? before.realtime : before.denoised;
    for (std::size_t t = 0; t < hold; ++t) response[t] += (a[kStraight + t] - b[kStraight + t]) / kRuns;
  }
  for (std::size_t t = 0; t < hold; ++t) {
    if (response[t] >= 0.9 * step) return t;
  }
  return std::nullopt;
}

// Limits are those that gyrod promises. Real noise: docs/measured.md, "At rest".
TEST(JointGuards, AStepOfTheBiasOfHalfADegreeASecondComesThroughWithinASecond) {
  EXPECT_LE(samples_to_90(0.5, 300, true).value_or(9999), kRate);
  EXPECT_LE(samples_to_90(0.5, 300, false).value_or(9999), kRate);
}

TEST(JointGuards, AStepOfTheBiasOfATwentiethOfADegreeASecondComesThroughWithinTenSeconds) {
  EXPECT_LE(samples_to_90(0.05, 1200, true).value_or(9999), 10 * kRate);
  EXPECT_LE(samples_to_90(0.05, 1200, false).value_or(9999), 10 * kRate);
}

// Method paper leaves 0.215 of the standard deviation of white noise (docs/method.md, "Known limits"). The mean of the answers is that
// of the samples within a tenth of what it is itself uncertain by, kNoise / sqrt(6000).
TEST(JointGuards, RestIsAsQuietAsByMethodPaperAtTheSameMean) {
  constexpr std::size_t kSize = 8000;
  constexpr std::size_t kBegin = 2000;
  const Signal z = testing::times(testing::white_noise(kSize, 4), kNoise);
  const JointOutput out = run(z);
  double moved = 0.0;
  double squares = 0.0;
  for (std::size_t t = kBegin; t < kSize - kLag; ++t) {
    moved += out.denoised[t] - z[t];
    squares += out.denoised[t] * out.denoised[t];
  }
  constexpr double kCount = kSize - kLag - kBegin;
  EXPECT_LT(std::sqrt(squares / kCount), 0.215 * kNoise);
  EXPECT_LT(std::abs(moved / kCount), 0.1 * kNoise / std::sqrt(kCount));
}

// A car that starts with its engine idling, 31 Hz and 3.7 deg/s on a quiet sensor: what the filters miss before the first model is given
// back. One sample of the tone is the most that may be owed; dropped at the first model, it was 17 and 10 deg/s.
TEST(JointGuards, TheSumOfTheAnswersStaysWithThatOfTheSamplesFromTheStartOn) {
  constexpr double kTone = 3.7;
  constexpr double kQuiet = 0.04;
  const Signal z = testing::sum(testing::times(testing::tone(1500, 0.31, 0.6), kTone),
                                testing::white_noise(1500, 5), kQuiet);
  const JointOutput out = testing::run_joint(z, core::white_noise(kQuiet * kQuiet), kLag);
  double realtime = 0.0;
  double denoised = 0.0;
  for (std::size_t t = 0; t < z.size() - kLag; ++t) {
    realtime += z[t] - out.realtime[t];
    denoised += z[t] - out.denoised[t];
  }
  EXPECT_LT(std::abs(realtime), kTone);
  EXPECT_LT(std::abs(denoised), kTone);
}

/// A slow swing of 3 deg/s, a wander, and noise.
Signal swaying(std::size_t size) {
  const std::vector<double> wander = {1.8, -0.82};
  const Signal truth = testing::sum(testing::times(testing::tone(size, 0.003), 3.0),
                                    testing::autoregressive(wander, size, 7), 0.05);
  return testing::sum(truth, testing::white_noise(size, 8), kNoise);
}

// A tone of 1 deg/s in noise of 1.04, beside motion. A causal filter loses the root of noise over signal, in its band: about a tenth. As a
// mode among others it lost 13 and 20 %.
TEST(JointGuards, AToneAsWeakAsTheNoiseKeepsItsSize) {
  constexpr std::size_t kSize = 8000;
  constexpr std::size_t kBegin = 2000;
  const Signal tone = testing::times(testing::tone(kSize, 0.225), kNoise / 1.04);
  const Signal without = swaying(kSize);
  const JointOutput before = run(without);
  const JointOutput after = run(testing::sum(without, tone, 1.0));
  const auto gain = [&](const Signal& with_tone, const Signal& plain) {
    double product = 0.0;
    double power = 0.0;
    for (std::size_t t = kBegin; t < kSize - kLag; ++t) {
      product += (with_tone[t] - plain[t]) * tone[t];
      power += tone[t] * tone[t];
    }
    return product / power;
  };
  EXPECT_NEAR(gain(after.denoised, before.denoised), 1.0, 0.12);
  EXPECT_NEAR(gain(after.realtime, before.realtime), 1.0, 0.12);
}

// A new model takes back the step that it would make in the answer. What it takes back is, on real drives, at most three of the ordinary
// steps from one answer to the next (docs/measured.md, "Hand-overs").
TEST(JointGuards, AHandOverMakesNoStep) {
  const Signal z = swaying(6000);
  core::JointFit fit(1024);
  core::JointOptions at_once;
  at_once.hand_over_memory = 0.0;
  core::KalmanBank sudden(at_once, kLag);
  core::KalmanBank bank({}, kLag);
  core::JointModel model;
  core::WindowReport report;
  double largest = 0.0;
  double largest_sudden = 0.0;
  double squares = 0.0;
  double last = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t % 32 == 0 && t >= 1056) {
      const core::BankEstimate before = bank.held(kLag);
      const core::BankEstimate before_sudden = sudden.held(kLag);
      fit.fit(std::span(z).subspan(t - 1056, 1024), core::white_noise(kNoise * kNoise), model, report);
      bank.use(model);
      sudden.use(model);
      if (t >= 2048) {
        largest = std::max(largest, std::abs(bank.held(kLag).rate - before.rate));
        largest_sudden = std::max(largest_sudden, std::abs(sudden.held(kLag).rate - before_sudden.rate));
      }
    }
    sudden.step(z[t]);
    const double answer = bank.step(z[t]).denoised.rate;
    if (t >= 2048) squares += (answer - last) * (answer - last);
    last = answer;
  }
  const double ordinary = std::sqrt(squares / static_cast<double>(z.size() - 2048));
  EXPECT_LT(largest, 1e-9);
  EXPECT_GT(largest_sudden, 0.1 * ordinary);
  EXPECT_LT(largest_sudden, 3.0 * ordinary);
}

// A quiet sensor is knocked: two swings of 50 deg/s within a third of a second, which no model expects. In a bank whose members could win by one
// sample, those that the motion crosses answered in turn.
TEST(JointGuards, AKnockIsFollowed) {
  constexpr std::size_t kBegin = 2064;
  constexpr std::size_t kSwing = 50;
  const Signal noise = testing::times(testing::white_noise(4096, 9), kNoise);
  Signal truth(noise.size(), 0.0);
  for (std::size_t t = 0; t < 2 * kSwing; ++t) {
    const double phase = std::numbers::pi * static_cast<double>(t) / kSwing;
    truth[kBegin + t] = 50.0 * std::sin(0.5 * phase) * std::sin(2.0 * phase);
  }
  const JointOutput out = run(testing::sum(truth, noise));
  double squares = 0.0;
  for (std::size_t t = kBegin; t < kBegin + 2 * kSwing; ++t)
    squares += std::pow(out.denoised[t] - truth[t], 2);
  EXPECT_LT(std::sqrt(squares / (2.0 * kSwing)), 1.0);
}

// The Butterworth is the one that is best for the yaw axis of WID trial 06 with this noise: order 2, 2.27 Hz at 120 Hz, 12 samples late
// (docs/measured.md, "Turns").
TEST(JointGuards, TakesATurnNoLaterThanTheButterworthTunedForTheDrive) {
  const core::Method joint{"joint", kLag, [](std::span<const double> noisy) {
                             core::Contender contender;
                             contender.estimate = run(Signal(noisy.begin(), noisy.end())).denoised;
                             return contender;
                           }};
  core::TunedRival tuned;
  tuned.setting = {core::Rival::kButterworth2, 2.27 / 120.0, 0.0, 12};
  const Signal noise = testing::times(testing::white_noise(20'000, 6), kNoise);
  core::TurnOptions options;
  options.straight_s = 20.0;  // two windows
  options.after_s = 3.3;
  options.repeats = 6;
  const core::TurnProfile& turn = core::kTurnProfiles[0];
  const core::TurnResponse ours = core::TurnTrials(joint, noise, options).take(turn);
  const core::TurnResponse theirs = core::TurnTrials(core::method_of(tuned), noise, options).take(turn);
  ASSERT_TRUE(ours.half_delay_s && ours.time_95_s && theirs.half_delay_s && theirs.time_95_s);
  EXPECT_LE(*ours.half_delay_s, *theirs.half_delay_s + 0.005);
  EXPECT_LE(*ours.time_95_s, *theirs.time_95_s);
  EXPECT_LE(ours.peak_error_dps, theirs.peak_error_dps);
}

/// A sensor at rest whose housing is tapped, 200 deg/s that ring for some samples: what no window has seen.
struct Taps {
  static constexpr std::size_t kFirst = 2500;
  static constexpr std::size_t kApart = 700;
  static constexpr std::size_t kCount = 6;
  Signal truth = Signal(kFirst + kCount * kApart, 0.0);

  Taps() {
    for (std::size_t k = 0; k < kCount; ++k) {
      const double angle = 0.7 + 0.4 * static_cast<double>(k);
      for (std::size_t n = 0; n < 60; ++n) {
        const auto t = static_cast<double>(n);
        truth[kFirst + k * kApart + n] = 200.0 * std::exp(-t / 6.0) * std::sin(angle * t + 1.0);
      }
    }
  }
  [[nodiscard]] JointOutput denoised() const {
    return run(testing::sum(truth, testing::white_noise(truth.size(), 5), kNoise));
  }
};

// Smeared by the filters, a tap made errors of 3 to 21 deg/s around it, where raw has 0.35.
TEST(JointGuards, AKnockMakesNothingMuchWorseThanRaw) {
  const Taps taps;
  const JointOutput out = taps.denoised();
  for (const Signal* estimate : {&out.realtime, &out.denoised}) {
    for (std::size_t k = 0; k < Taps::kCount; ++k) {
      const std::size_t begin = Taps::kFirst + k * Taps::kApart;
      EXPECT_LT(testing::rms_difference(*estimate, taps.truth, begin - 40, begin + 100), 1.3 * kNoise) << k;
      EXPECT_LT(testing::rms_difference(*estimate, taps.truth, begin - 300, begin - 40), 1.1 * kNoise) << k;
    }
  }
}

// With knocks in the window that is fitted, hardly any noise was taken off for as long as one was in it: 0.9 of raw and more.
TEST(JointGuards, AKnockIsForgottenAtOnce) {
  const Taps taps;
  const JointOutput out = taps.denoised();
  for (const Signal* estimate : {&out.realtime, &out.denoised}) {
    for (std::size_t k = 0; k < Taps::kCount; ++k) {
      const std::size_t begin = Taps::kFirst + k * Taps::kApart;
      EXPECT_LT(testing::rms_difference(*estimate, taps.truth, begin + 150, begin + 650), 0.35 * kNoise) << k;
    }
  }
}

}  // namespace
}  // namespace gyrod
