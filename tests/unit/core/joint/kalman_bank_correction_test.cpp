// What the bank gives back of slow motion, and how fast.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <gtest/gtest.h>

#include "core/joint/gain_correction.hpp"
#include "core/joint/later_gain.hpp"
#include "core/joint/slow_correction.hpp"
#include "unit/core/joint/bank_support.hpp"

namespace gyrod {
namespace {

using core::BlockSet;
using core::JointModel;
using core::JointOptions;
using core::KalmanBank;
using testing::bare;
using testing::blocks;
using testing::kBankNoise;
using testing::Signal;
using testing::simulated;
using testing::single;

constexpr double kMemory = 50.0;
constexpr double kShare = 10.0;

JointOptions correcting() {
  JointOptions options = bare();
  options.correction_rate = 0.006;
  options.still_correction = 1.0;
  options.correction_share = 0.04;
  options.steady_correction = kShare;
  options.most_steady_correction = 0.04;
  options.steady_memory = kMemory;
  return options;
}

/// Motion driven by `drive` times the variance: the more, the larger is P.
JointModel moving(double drive) {
  BlockSet set = blocks();
  for (core::FilterBlock& block : set.blocks) block.drive *= block.signal > 0.0 ? drive : 1.0;
  JointModel model = single(set);
  model.noise_variance = model.slow_noise_variance = kBankNoise;
  return model;
}

/// The answer is e + c (owed + z - e): what it differs by from that of a bank without correction, over owed + z - e, is c.
class Rates {
 public:
  Rates() : plain_(bare(), 0), bank_(correcting(), 0) {}

  void use(const JointModel& model) {
    settled_ = model.member(core::MemberKind::kFull).error_variance(core::kMaxLag) / kBankNoise;
    plain_.use(model);
    bank_.use(model);
  }
  double step(double sample) {
    const core::BankEstimate e = plain_.step(sample).realtime;
    const double out = bank_.step(sample).realtime.rate;
    const double rate = (out - e.rate) / (owed_ + sample - e.rate);
    expected_ = e.variance / kBankNoise;
    owed_ += sample - out;
    return rate;
  }
  /// Variance over the noise's, without look-ahead and with the largest there is: constant under one model of one member.
  [[nodiscard]] double expected() const { return expected_; }
  [[nodiscard]] double settled() const { return settled_; }
  /// c where the least of late is s.
  [[nodiscard]] double rate_at(double s) const {
    return std::max({0.006, 0.04 * expected_, std::min(kShare * s * s * s * settled_ / expected_, 0.04)});
  }

 private:
  KalmanBank plain_;
  KalmanBank bank_;
  double owed_ = 0.0;
  double expected_ = 0.0;
  double settled_ = 0.0;
};

// With P constant the least of late comes up to it as 1 - (1 - 1/M)^t, and the rate with its cube.
TEST(KalmanBankCorrection, IsFasterTheLongerTheVarianceHasBeenLarge) {
  Rates rates;
  rates.use(moving(0.1));
  double before = 0.0;
  int t = 0;
  for (const double sample : simulated(blocks(), 600, 4)) {
    const double rate = rates.step(sample);
    const double expected = rates.rate_at(rates.settled() * (1.0 - std::pow(1.0 - 1.0 / kMemory, ++t)));
    ASSERT_NEAR(rate, expected, 1e-6 * expected) << t;
    ASSERT_GE(expected, before);
    before = expected;
  }
  EXPECT_GT(before, 1.2 * std::max(0.006, 0.04 * rates.expected())) << "the cube counts";
}

// A turn between straight stretches makes P large for a moment: no reason to let the noise of slow motion through.
TEST(KalmanBankCorrection, ForgetsAtOnceThatTheVarianceWasLarge) {
  Rates rates;
  rates.use(moving(0.1));
  const Signal z = simulated(blocks(), 600, 4);
  for (std::size_t t = 0; t < 300; ++t) rates.step(z[t]);
  rates.use(moving(0.001));
  const double rate = rates.step(z[300]);
  EXPECT_NEAR(rate, rates.rate_at(rates.settled()), 1e-9);
}

// Both outputs are told what the newest sample shows: an answer with look-ahead knows of a turn before it comes to it.
TEST(KalmanBankCorrection, KnowsWhereNothingSlowMoves) {
  constexpr std::size_t kLookAhead = 8;
  JointOptions options = bare();
  options.correction_rate = 0.006;
  options.residual_weight = 0.0;
  JointModel model = single(blocks());
  model.noise_variance = model.slow_noise_variance = kBankNoise;
  KalmanBank plain(bare(), kLookAhead);
  KalmanBank bank(options, kLookAhead);
  plain.use(model);
  bank.use(model);
  core::SlowMotion motion;
  Signal z = testing::times(testing::white_noise(4000, 4), std::sqrt(kBankNoise));
  for (std::size_t t = 3500; t < z.size(); ++t) z[t] += 5.0;
  double realtime_owed = 0.0;
  double denoised_owed = 0.0;
  double least = 1.0;
  double last = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    const core::BankEstimates e = plain.step(z[t]);
    const core::BankEstimates out = bank.step(z[t]);
    const double strength = motion.follow(z[t], kBankNoise, options, {});
    const double moving =
        std::clamp((strength - options.motion_low) / (options.motion_high - options.motion_low), 0.0, 1.0);
    const double rate = 0.006 * (options.still_correction + (1.0 - options.still_correction) * moving);
    ASSERT_NEAR(out.realtime.rate, e.realtime.rate + rate * (realtime_owed + z[t] - e.realtime.rate), 1e-9)
        << t;
    realtime_owed += z[t] - out.realtime.rate;
    least = std::min(least, moving);
    last = moving;
    if (t < kLookAhead) continue;
    const double then = z[t - kLookAhead];
    ASSERT_NEAR(out.denoised.rate, e.denoised.rate + rate * (denoised_owed + then - e.denoised.rate), 1e-9)
        << t;
    denoised_owed += then - out.denoised.rate;
  }
  EXPECT_EQ(least, 0.0);
  EXPECT_EQ(last, 1.0);
}

TEST(KalmanBankCorrection, AResetForgetsThatNothingMoved) {
  JointOptions options = bare();
  options.correction_rate = 0.006;
  JointModel model = single(blocks());
  model.noise_variance = model.slow_noise_variance = kBankNoise;
  KalmanBank bank(options, 0);
  bank.use(model);
  const Signal z = testing::times(testing::white_noise(4000, 4), std::sqrt(kBankNoise));
  for (const double sample : z) bank.step(sample);
  bank.reset();
  bank.use(model);
  KalmanBank fresh(options, 0);
  fresh.use(model);
  for (std::size_t t = 0; t < 200; ++t) {
    ASSERT_EQ(bank.step(z[t]).realtime.rate, fresh.step(z[t]).realtime.rate) << t;
  }
}

// What has been left of the samples since, by the answers at once.
TEST(KalmanBankCorrection, WithLookAheadKnowsWhatIsLeftOfNewerSamples) {
  constexpr std::size_t kLookAhead = 8;
  JointOptions options = bare();
  options.correction_rate = 0.02;
  KalmanBank plain(bare(), kLookAhead);
  KalmanBank bank(options, kLookAhead);
  plain.use(single(blocks()));
  bank.use(single(blocks()));
  core::SlowCorrection beside;
  const Signal z = simulated(blocks(), 400, 4);
  Signal left;
  for (std::size_t t = 0; t < z.size(); ++t) {
    const core::BankEstimates e = plain.step(z[t]);
    const double answer = bank.step(z[t]).denoised.rate;
    left.push_back(z[t] - e.realtime.rate);
    if (t < kLookAhead) continue;
    const double expected =
        beside.apply(z[t - kLookAhead], e.denoised.rate, {}, options, {}, std::span(left).last(kLookAhead));
    ASSERT_NEAR(answer, expected, 1e-12) << t;
  }
}

// What is late by what it leaves of its own samples, what comes at once by what is answered later; an answer that is held until the end has what the
// last one was given. Of neither does the slow correction know.
TEST(KalmanBankCorrection, GivesBothAnswersTheSizeOfSlowMotion) {
  constexpr std::size_t kLookAhead = 16;
  JointOptions without = bare();
  without.correction_rate = 0.006;
  JointOptions options = without;
  options.most_gain = 0.1;
  options.most_later_gain = 0.3;
  options.most_later_loss = 0.3;
  options.gain_memory = options.later_memory = 64.0;
  KalmanBank plain(without, kLookAhead);
  KalmanBank bank(options, kLookAhead);
  JointModel model = moving(0.1);
  plain.use(model);
  bank.use(model);
  core::GainCorrection beside;
  core::LaterGain at_once;
  Signal answers;
  const Signal z = simulated(blocks(), 400, 4);
  double most = 0.0;
  double most_at_once = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    const core::BankEstimates as_they_are = plain.step(z[t]);
    const core::BankEstimates with = bank.step(z[t]);
    answers.push_back(as_they_are.realtime.rate);
    const double realtime = at_once.apply(answers[t], kBankNoise, options, {});
    ASSERT_NEAR(with.realtime.rate, realtime, 1e-12) << t;
    most_at_once = std::max(most_at_once, std::abs(realtime - answers[t]));
    if (t < kLookAhead) continue;
    const double expected =
        beside.apply(z[t - kLookAhead], as_they_are.denoised.rate, kBankNoise, options, {});
    ASSERT_NEAR(with.denoised.rate, expected, 1e-12) << t;
    ASSERT_NEAR(bank.held(3).rate - plain.held(3).rate, beside.paid(), 1e-12) << t;
    most = std::max(most, std::abs(beside.paid()));
    at_once.compare(expected, answers[t - kLookAhead], options, {});
  }
  EXPECT_GT(most, 0.0);
  EXPECT_GT(most_at_once, 0.0);
}

// Answers of 16 samples' look-ahead are made besides where the bank answers sooner; with one member there is no hindsight to tell them apart.
TEST(KalmanBankCorrection, AnswersAtOnceAreAlikeWhereTheLagIsShort) {
  KalmanBank standard(JointOptions{}, KalmanBank::kLeastLater);
  KalmanBank shorter(JointOptions{}, 5);
  KalmanBank none(JointOptions{}, 0);
  const JointModel first = moving(0.1);
  const JointModel second = moving(0.4);
  const Signal z = simulated(blocks(), 600, 4);
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t % 200 == 100) {
      for (KalmanBank* bank : {&standard, &shorter, &none}) bank->use(t < 200 ? first : second);
    }
    const double expected = standard.step(z[t]).realtime.rate;
    ASSERT_EQ(shorter.step(z[t]).realtime.rate, expected) << t;
    const core::BankEstimates answers = none.step(z[t]);
    ASSERT_EQ(answers.realtime.rate, expected) << t;
    ASSERT_EQ(answers.denoised.rate, expected) << t;
    ASSERT_NEAR(none.held(0).rate, expected, 1e-12) << t;
  }
}

}  // namespace
}  // namespace gyrod
