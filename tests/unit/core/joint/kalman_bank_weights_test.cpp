// How the bank weighs its members, and what a model brings along that takes over.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "unit/core/joint/bank_support.hpp"

namespace gyrod {
namespace {

using core::BankEstimates;
using core::BlockSet;
using core::FilterBlock;
using core::JointModel;
using core::JointOptions;
using core::KalmanBank;
using core::MemberDesigner;
using core::MemberKind;
using testing::bare;
using testing::blocks;
using testing::kBankNoise;
using testing::Signal;
using testing::simulated;
using testing::single;

// The member whose model the data follow takes over from one that expects a hundredth of the motion.
TEST(KalmanBank, TrustsTheMemberThatPredictsBest) {
  const BlockSet right = blocks();
  BlockSet wrong = right;
  for (FilterBlock& block : wrong.blocks) block.drive *= block.signal > 0.0 ? 1e-2 : 1.0;
  JointModel model = single(wrong);
  ASSERT_TRUE(MemberDesigner().design(right, kBankNoise, model.member(MemberKind::kPruned)));
  KalmanBank bank(bare(), 16);
  KalmanBank best(bare(), 16);
  bank.use(model);
  best.use(single(right));
  const Signal z = simulated(right, 2000, 5);
  double apart = 0.0;
  double size = 0.0;
  for (const double sample : z) {
    const double expected = best.step(sample).realtime.rate;
    apart += std::pow(bank.step(sample).realtime.rate - expected, 2);
    size += expected * expected;
  }
  EXPECT_LT(apart, 0.01 * size);
}

/// Answers 0 whatever comes in, and expects this innovation variance S and this error P.
core::MemberModel indifferent(double innovation_variance, double prediction_variance) {
  core::MemberModel member;
  member.blocks.add({.order = 1, .drive = 1.0, .signal = 1.0});
  member.states = 1;
  member.innovation_variance = innovation_variance;
  member.prediction_variance = prediction_variance;
  member.usable = true;
  return member;
}

// Two members that answer 0 whatever comes in, and expect different spreads: the mixture's variance, w P_1 + (1 - w) P_2, tells the weights.
// They follow Bayes' rule with switching, written down here once more, with no more evidence by a sample than most_evidence.
class KalmanBankEvidence : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(AtMost, KalmanBankEvidence, ::testing::Values(0.05, 0.5, 1e12));

TEST_P(KalmanBankEvidence, WeighsByEvidenceAndByTheChanceOfASwitch) {
  constexpr double kNarrow = 2.0;  // S of either
  constexpr double kWide = 5.0;
  JointOptions options = bare();
  options.switching_rate = 0.01;
  options.likelihood_power = 0.4;
  options.most_evidence = GetParam();
  JointModel model;
  model.member(MemberKind::kFull) = indifferent(kNarrow, 1.0);
  model.member(MemberKind::kPruned) = indifferent(kWide, 4.0);  // its prior is as large
  KalmanBank bank(options, 0);
  bank.use(model);
  double weight = 0.5;
  for (const double z : testing::times(testing::white_noise(300, 11), 1.7)) {
    // The narrow one is always the farther off.
    const double behind = std::min(0.4 * 0.5 * (z * z / kNarrow - z * z / kWide), options.most_evidence);
    const double first = (0.99 * weight + 0.01 * 0.5) * std::exp(-behind) / std::pow(kNarrow, 0.5 * 0.4);
    const double second = (0.99 * (1.0 - weight) + 0.01 * 0.5) / std::pow(kWide, 0.5 * 0.4);
    weight = first / (first + second);
    EXPECT_NEAR(bank.step(z).realtime.variance, weight + 4.0 * (1.0 - weight), 1e-12);
  }
}

// All members predict alike, so that weights stay what the priors are: 1/4 to 1 where the model says so.
TEST(KalmanBank, WeighsTheFullSetAsTheModelHasIt) {
  constexpr double kPart = 0.25;
  JointModel model;
  model.member(MemberKind::kFull) = indifferent(2.0, 1.0);
  model.member(MemberKind::kPruned) = indifferent(2.0, 4.0);
  model.member(MemberKind::kRough) = indifferent(2.0, 9.0);
  model.full_prior = kPart;
  KalmanBank bank(bare(), 0);
  bank.use(model);
  const double rough = std::exp(bare().rough_log_prior);
  const double expected = (kPart * 1.0 + 4.0 + kPart * rough * 9.0) / (kPart + 1.0 + kPart * rough);
  for (const double z : testing::white_noise(50, 3)) {
    EXPECT_NEAR(bank.step(z).realtime.variance, expected, 1e-12);
  }
}

// The published variance is the mixture's times the factor, at once and later.
TEST(KalmanBank, PublishesAVarianceWidenedByTheFactor) {
  JointOptions options = bare();
  KalmanBank plain(options, 8);
  options.variance_factor = 1.5;
  KalmanBank widened(options, 8);
  plain.use(single(blocks()));
  widened.use(single(blocks()));
  for (const double sample : simulated(blocks(), 50, 12)) {
    const BankEstimates a = plain.step(sample);
    const BankEstimates b = widened.step(sample);
    EXPECT_EQ(b.realtime.variance, 1.5 * a.realtime.variance);
    EXPECT_EQ(b.denoised.variance, 1.5 * a.denoised.variance);
    EXPECT_EQ(b.denoised.rate, a.denoised.rate);
  }
  EXPECT_EQ(widened.held(3).variance, 1.5 * plain.held(3).variance);
}

// A new model begins where the last one was: the step to it, here to one that expects a tenth of the motion, is taken back and
// fades by hand_over_memory with every sample. 1e-12: rounding.
TEST(KalmanBank, ANewModelMakesNoStep) {
  constexpr double kMemory = 0.75;
  JointOptions gently = bare();
  gently.hand_over_memory = kMemory;
  KalmanBank sudden(bare(), 16);
  KalmanBank gentle(gently, 16);
  for (KalmanBank* bank : {&sudden, &gentle}) bank->use(single(blocks()));
  const Signal z = simulated(blocks(), 400, 13);
  BankEstimates before;
  for (std::size_t t = 0; t < 300; ++t) {
    for (KalmanBank* bank : {&sudden, &gentle}) before = bank->step(z[t]);
  }
  BlockSet calmer = blocks();
  for (FilterBlock& block : calmer.blocks) block.drive *= 0.1;
  sudden.use(single(calmer));
  gentle.use(single(calmer));
  const double step = before.denoised.rate - sudden.held(16).rate;
  ASSERT_GT(std::abs(step), 0.01);
  EXPECT_NEAR(gentle.held(16).rate, before.denoised.rate, 1e-12);
  double left = step;
  for (std::size_t t = 300; t < z.size(); ++t) {
    left *= kMemory;
    EXPECT_NEAR(gentle.step(z[t]).denoised.rate - sudden.step(z[t]).denoised.rate, left, 1e-12);
  }
}

// What is left of one step is not forgotten where the next model makes another: both fade. 1e-12: rounding.
TEST(KalmanBank, StepsOfModelsThatFollowOneAnotherAddUp) {
  JointOptions gently = bare();
  gently.hand_over_memory = 0.75;
  KalmanBank sudden(bare(), 16);
  KalmanBank gentle(gently, 16);
  for (KalmanBank* bank : {&sudden, &gentle}) bank->use(single(blocks()));
  const Signal z = simulated(blocks(), 340, 13);
  BankEstimates before;
  double realtime = 0.0;
  double denoised = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 300 || t == 303) {
      BlockSet other = blocks();
      for (FilterBlock& block : other.blocks) block.drive *= t == 300 ? 0.1 : 0.3;
      for (KalmanBank* bank : {&sudden, &gentle}) bank->use(single(other));
      realtime += before.realtime.rate - sudden.held(0).rate;
      denoised += before.denoised.rate - sudden.held(16).rate;
    }
    realtime *= gently.hand_over_memory;
    denoised *= gently.hand_over_memory;
    before = sudden.step(z[t]);
    const BankEstimates answer = gentle.step(z[t]);
    EXPECT_NEAR(answer.realtime.rate - before.realtime.rate, realtime, 1e-12) << t;
    EXPECT_NEAR(answer.denoised.rate - before.denoised.rate, denoised, 1e-12) << t;
  }
}

// 1e308 x[t-1] - 1e308 x[t-2] of states that are ten times an innovation is infinity less infinity: with the second sample that member is out.
TEST(KalmanBank, AMemberThatLeavesTheNumbersLeavesTheAnswerToTheOthers) {
  JointModel model = single(blocks());
  core::MemberModel& lost = model.member(MemberKind::kPruned);
  lost.blocks.add({.order = 2, .a = {1e308, -1e308}, .drive = 1.0, .signal = 1.0});
  lost.states = 2;
  lost.gain = {10.0, 10.0};
  lost.innovation_variance = 1.0;
  lost.usable = true;
  KalmanBank bank(bare(), 4);
  KalmanBank alone(bare(), 4);
  bank.use(model);
  alone.use(single(blocks()));
  const Signal z = simulated(blocks(), 100, 14);
  ASSERT_GT(std::abs(z[0]), 0.2);
  bank.step(z[0]);
  alone.step(z[0]);
  for (std::size_t t = 1; t < z.size(); ++t) {
    const BankEstimates answer = bank.step(z[t]);
    const BankEstimates expected = alone.step(z[t]);
    EXPECT_EQ(answer.realtime.rate, expected.realtime.rate) << t;
    EXPECT_EQ(answer.realtime.variance, expected.realtime.variance) << t;
    EXPECT_EQ(answer.denoised.rate, t > 4 ? expected.denoised.rate : answer.denoised.rate) << t;
  }
}

// The same where the samples that a new model is run over first are too much for one of its members.
TEST(KalmanBank, AMemberThatIsLostInTheHandOverLeavesTheAnswerToTheOthers) {
  JointModel both = single(blocks());
  ASSERT_TRUE(MemberDesigner().design(blocks(), kBankNoise, both.member(MemberKind::kPruned)));
  JointModel broken = both;
  core::MemberModel& lost = broken.member(MemberKind::kPruned);
  lost.blocks = {};
  lost.blocks.add({.order = 2, .a = {1e308, -1e308}, .drive = 1.0, .signal = 1.0});
  lost.states = 2;
  lost.gain.fill(10.0);
  JointOptions options = bare();
  options.hand_over_memory = 0.75;
  KalmanBank bank(options, 4);
  KalmanBank alone(options, 4);
  const Signal z = simulated(blocks(), 100, 15);
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 0) bank.use(both);
    if (t == 0) alone.use(both);
    if (t == 50) bank.use(broken);
    if (t == 50) alone.use(single(blocks()));
    EXPECT_EQ(bank.step(z[t]).denoised.rate, alone.step(z[t]).denoised.rate) << t;
  }
}

// nu^2 / S of ten deviations is the most that counts of one sample; the mean takes a 256th of it. A knock of 2400 would be felt for 2700 samples.
TEST(KalmanBank, TheMeanOfInnovationsCountsTenDeviationsAtTheMost) {
  const JointModel model = single(blocks());
  const double S = model.member(MemberKind::kFull).innovation_variance;
  for (const double deviations : {3.0, 9.0, 11.0, 2400.0, 1e9}) {
    KalmanBank bank(bare(), 0);
    bank.use(model);
    bank.step(deviations * std::sqrt(S));
    const double square = std::min(deviations * deviations, 100.0);
    EXPECT_NEAR(bank.normalised_innovation(), 1.0 + (square - 1.0) / 256.0, 1e-9 * square) << deviations;
  }
}

// The scale of a model acts on what the bank was given, and on nothing else. After motion nothing but noise: what is said of slow motion takes
// tens of thousands of samples to fade there.
void take_all_at_the_models_scale(double rate_hz, std::size_t window) {
  SCOPED_TRACE(::testing::Message() << rate_hz << " Hz, window " << window);
  Signal z = simulated(blocks(), 500, 9);
  const Signal still = testing::times(testing::white_noise(30000, 10), std::sqrt(kBankNoise));
  z.insert(z.end(), still.begin(), still.end());
  JointModel model = single(blocks());
  model.noise_variance = model.slow_noise_variance = kBankNoise;
  BlockSet lively = blocks();
  lively.blocks[1].drive *= 10.0;
  ASSERT_TRUE(MemberDesigner().design(lively, kBankNoise, model.member(MemberKind::kPruned)));
  JointModel scaled = model;
  scaled.scale = core::JointScale(rate_hz, window);
  JointOptions options;
  options.correction_share = 0.0;  // else the rest hardly counts here
  KalmanBank bank(options, 16);
  bank.use(scaled);
  options.switching_rate = scaled.scale.switching_rate(options.switching_rate);
  options.hindsight_rate = scaled.scale.switching_rate(options.hindsight_rate);
  options.correction_rate = scaled.scale.correction_rate(options.correction_rate);
  options.most_steady_correction = scaled.scale.pace(options.most_steady_correction);
  options.most_late_steady_correction = scaled.scale.pace(options.most_late_steady_correction);
  for (double* samples : {&options.steady_memory, &options.motion_mean, &options.motion_memory})
    *samples = scaled.scale.memory(*samples);
  for (double* samples : {&options.gain_band, &options.gain_follow, &options.gain_mean, &options.gain_memory,
                          &options.later_follow, &options.later_memory})
    *samples = scaled.scale.duration(*samples);
  KalmanBank expected(options, 16);
  expected.use(model);
  for (const double sample : z) {
    const BankEstimates ours = bank.step(sample);
    const BankEstimates theirs = expected.step(sample);
    ASSERT_EQ(ours.denoised.rate, theirs.denoised.rate);
    ASSERT_EQ(ours.realtime.rate, theirs.realtime.rate);
  }
}

TEST(KalmanBank, TakesSwitchingAndCorrectionsAtTheModelsScale) {
  take_all_at_the_models_scale(480.0, 512);
  take_all_at_the_models_scale(60.0, 1024);
}

}  // namespace
}  // namespace gyrod
