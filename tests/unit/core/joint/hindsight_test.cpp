// How the bank weighs its members for answers with look-ahead, against covariances of the whole record.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "unit/core/joint/bank_batch.hpp"
#include "unit/core/joint/bank_support.hpp"

namespace gyrod {
namespace {

using core::BlockSet;
using core::JointModel;
using core::JointOptions;
using core::KalmanBank;
using core::MemberDesigner;
using core::MemberKind;
using core::MemberModel;
using testing::bare;
using testing::Batch;
using testing::blocks;
using testing::kBankNoise;
using testing::Signal;
using testing::simulated;
using testing::single;
constexpr std::size_t kSamples = 200;

BlockSet lively() {
  BlockSet set = blocks();
  set.blocks[1].drive *= 10.0;
  return set;
}

// The variance of a sample beside all others is r / (1 - h): h = 1 - r / that.
TEST(Hindsight, LeverageIsThatOfTheWholeRecord) {
  const Batch batch(blocks(), Signal(kSamples, 0.0));
  const MemberModel member = single(blocks()).member(MemberKind::kFull);
  for (std::size_t lag = 0; lag <= core::kMaxLag; ++lag) {
    const double variance = batch.apart_variance(static_cast<Eigen::Index>(kSamples - 1 - lag));
    EXPECT_NEAR(member.leverage(lag), 1.0 - kBankNoise / variance, 1e-9) << lag;
  }
}

TEST(Hindsight, LeverageIsWithinZeroAndOne) {
  MemberModel member;
  member.white_variance = 1.0;
  member.innovation_variance = 1.5;
  member.whole_smoothing = {0.5, 1.0};
  EXPECT_NEAR(member.leverage(0), 0.125, 1e-15);
  EXPECT_EQ(member.leverage(1), 0.0);
  member.innovation_variance = 9.0;
  member.whole_smoothing = {};
  EXPECT_EQ(member.leverage(0), 1.0);
}

/// The density of what a sample is beside others, to the power of the bank's likelihoods.
double density(double apart, double variance, double power) {
  return std::pow(std::exp(-apart * apart / variance) / variance, 0.5 * power);
}

/// The answer of a bank whose two members are new, w (v / w)^b: w from the newest sample beside those before it, v from
/// z[t-lag] beside all others.
double expected_answer(const std::array<Batch, 2>& members, std::size_t lag, double b, double power) {
  const auto now = static_cast<Eigen::Index>(kSamples - 1);
  const auto then = static_cast<Eigen::Index>(kSamples - 1 - lag);
  std::array<double, 2> w{};
  std::array<double, 2> v{};
  for (std::size_t i = 0; i < 2; ++i) {
    w[i] = density(members[i].apart(now), members[i].apart_variance(now), power);
    v[i] = density(members[i].apart(then), members[i].apart_variance(then), power);
  }
  const double first = std::pow(w[0] / w[1], 1.0 - b) * std::pow(v[0] / v[1], b);
  return (first * members[0].mean(then) + members[1].mean(then)) / (first + 1.0);
}

/// A bank that takes its two members over, weighed alike, before the last sample.
double answer_of(const JointOptions& options, std::size_t lag, const Signal& z) {
  JointModel model = single(blocks());
  EXPECT_TRUE(MemberDesigner().design(lively(), kBankNoise, model.member(MemberKind::kPruned)));
  KalmanBank bank(options, lag);
  for (std::size_t t = 0; t + 1 < z.size(); ++t) bank.step(z[t]);
  bank.use(model);
  return bank.step(z.back()).denoised.rate;
}

TEST(Hindsight, WeighsByTheSampleThatIsAskedFor) {
  JointOptions options = bare();
  options.most_evidence = 1e12;
  for (const unsigned seed : {1U, 2U, 3U}) {
    Signal z = simulated(lively(), kSamples, seed);
    for (const auto& [lag, b] :
         {std::pair<std::size_t, double>{1, 1.0 / 32.0}, {4, 0.125}, {12, 0.25}, {16, 0.5}, {32, 0.5}}) {
      z[kSamples - 1 - lag] += 3.0;
      const std::array<Batch, 2> members{Batch(blocks(), z), Batch(lively(), z)};
      EXPECT_NEAR(answer_of(options, lag, z), expected_answer(members, lag, b, options.likelihood_power),
                  1e-8)
          << lag;
    }
  }
}

// Without look-ahead hindsight knows nothing, and says nothing.
TEST(Hindsight, LeavesAnswersAtOnceAsTheyAre) {
  JointModel model = single(blocks());
  ASSERT_TRUE(MemberDesigner().design(lively(), kBankNoise, model.member(MemberKind::kPruned)));
  KalmanBank at_once(bare(), 0);
  KalmanBank late(bare(), 16);
  at_once.use(model);
  late.use(model);
  for (const double sample : simulated(lively(), kSamples, 7))
    ASSERT_EQ(at_once.step(sample).realtime.rate, late.step(sample).realtime.rate);
}

// A model that is the same again changes nothing: what hindsight has learned of the members is theirs.
TEST(Hindsight, IsInherited) {
  JointModel model = single(blocks());
  ASSERT_TRUE(MemberDesigner().design(lively(), kBankNoise, model.member(MemberKind::kPruned)));
  KalmanBank once(bare(), 16);
  KalmanBank again(bare(), 16);
  once.use(model);
  again.use(model);
  const Signal z = simulated(lively(), kSamples, 9);
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 150) again.use(model);
    ASSERT_NEAR(once.step(z[t]).denoised.rate, again.step(z[t]).denoised.rate, 1e-9) << t;
  }
}

// It has a rate of its own, that of how often members take turns in it.
TEST(Hindsight, ForgetsAtItsRate) {
  JointModel model = single(blocks());
  ASSERT_TRUE(MemberDesigner().design(lively(), kBankNoise, model.member(MemberKind::kPruned)));
  JointOptions forgetful = bare();
  forgetful.hindsight_rate = 0.1;
  KalmanBank bank(bare(), 16);
  KalmanBank other(forgetful, 16);
  bank.use(model);
  other.use(model);
  double apart = 0.0;
  for (const double sample : simulated(lively(), kSamples, 9)) {
    const core::BankEstimates answer = bank.step(sample);
    const core::BankEstimates forgotten = other.step(sample);
    ASSERT_EQ(answer.realtime.rate, forgotten.realtime.rate);
    apart = std::max(apart, std::abs(answer.denoised.rate - forgotten.denoised.rate));
  }
  EXPECT_GT(apart, 1e-3);
}

// However far off, one sample takes no more than most_evidence off a member's weight: of weights that were alike, both keep more than a third.
TEST(Hindsight, OneSampleDoesNotDecideAlone) {
  JointOptions options = bare();
  options.most_evidence = 0.1;
  Signal z = simulated(blocks(), kSamples, 4);
  z[kSamples - 17] += 1e4;
  const auto then = static_cast<Eigen::Index>(kSamples - 17);
  const double first = Batch(blocks(), z).mean(then);
  const double second = Batch(lively(), z).mean(then);
  const double share = (answer_of(options, 16, z) - first) / (second - first);
  EXPECT_GT(share, 1.0 / 3.0);
  EXPECT_LT(share, 2.0 / 3.0);
}

}  // namespace
}  // namespace gyrod
