// How the bank weighs its members for answers with look-ahead, against covariances of the whole record.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/slow_build.hpp"
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

/// Two members that weigh alike a priori.
JointModel two_members() {
  JointModel model = single(blocks());
  EXPECT_TRUE(MemberDesigner().design(lively(), kBankNoise, model.member(MemberKind::kPruned)));
  return model;
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
  EXPECT_EQ(member.leverage(0), 1.0) << "nothing is white";
  member.white_variance = 1.0;
  member.innovation_variance = 1.5;
  member.whole_smoothing = {0.5, 1.0};
  EXPECT_NEAR(member.leverage(0), 0.125, 1e-15);
  EXPECT_EQ(member.leverage(1), 0.0);
  member.innovation_variance = 9.0;
  member.whole_smoothing = {};
  EXPECT_EQ(member.leverage(0), 1.0);
}

/// Logarithm of the density of what a sample is beside others, to the power of the bank's likelihoods.
double evidence(const Batch& batch, std::size_t time, double power) {
  const auto t = static_cast<Eigen::Index>(time);
  const double variance = batch.apart_variance(t);
  return -0.5 * power * (std::log(variance) + batch.apart(t) * batch.apart(t) / variance);
}

/// The answer of a bank whose two members are new, and weighed alike, at z[n-1-lag]: w (v / u)^b, with w from every sample since beside those before
/// it, u the same of the first of them alone, v from every sample `lag` before these beside all others that were known.
double expected_answer(const std::array<BlockSet, 2>& sets, const Signal& z, std::size_t lag, double b,
                       double power) {
  std::array<double, 2> log_weight{};
  std::array<double, 2> mean{};
  const std::size_t first = z.size() - 1 - lag;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t t = first; t < z.size(); ++t) {
      const Batch known(sets[i], Signal(z.begin(), z.begin() + static_cast<std::ptrdiff_t>(t + 1)));
      log_weight[i] +=
          evidence(known, t, power) * (t == first ? 1.0 - b : 1.0) + b * evidence(known, t - lag, power);
      mean[i] = known.mean(static_cast<Eigen::Index>(first));
    }
  }
  const double one = std::exp(log_weight[0] - log_weight[1]);
  return (one * mean[0] + mean[1]) / (one + 1.0);
}

/// A bank that takes its two members over, weighed alike, before z[n-1-lag].
double answer_of(const JointOptions& options, std::size_t lag, const Signal& z) {
  const JointModel model = two_members();
  KalmanBank bank(options, lag);
  double answer = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == z.size() - 1 - lag) bank.use(model);
    answer = bank.step(z[t]).denoised.rate;
  }
  return answer;
}

TEST(Hindsight, TakesThePlaceOfAPartOfWhatInnovationsHadSaid) {
  JointOptions options = bare();
  options.most_evidence = 1e12;
  options.switching_rate = 0.0;
  options.hindsight_rate = 0.0;
  for (const auto& [lag, b] :
       {std::pair<std::size_t, double>{1, 1.0 / 32.0}, {4, 0.125}, {12, 0.25}, {16, 0.5}, {32, 0.5}}) {
    if (testing::kSlowBuild && lag > 4) break;  // half a minute of exact posteriors
    const Signal z = simulated(lively(), kSamples, static_cast<unsigned>(lag));
    const std::array<BlockSet, 2> sets{blocks(), lively()};
    EXPECT_NEAR(answer_of(options, lag, z), expected_answer(sets, z, lag, b, options.likelihood_power), 1e-8)
        << lag;
  }
}

// Without look-ahead hindsight knows nothing, and says nothing.
TEST(Hindsight, LeavesAnswersAtOnceAsTheyAre) {
  KalmanBank at_once(bare(), 0);
  KalmanBank late(bare(), 16);
  at_once.use(two_members());
  late.use(two_members());
  for (const double sample : simulated(lively(), kSamples, 7))
    ASSERT_EQ(at_once.step(sample).realtime.rate, late.step(sample).realtime.rate);
}

// A model that is the same again changes nothing: what hindsight has learned of the members is theirs.
TEST(Hindsight, IsInherited) {
  KalmanBank once(bare(), 16);
  KalmanBank again(bare(), 16);
  once.use(two_members());
  again.use(two_members());
  const Signal z = simulated(lively(), kSamples, 9);
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 150) again.use(two_members());
    ASSERT_NEAR(once.step(z[t]).denoised.rate, again.step(z[t]).denoised.rate, 1e-9) << t;
  }
}

// It has a rate of its own, that of how often members take turns in it.
TEST(Hindsight, ForgetsAtItsRate) {
  JointOptions forgetful = bare();
  forgetful.hindsight_rate = 0.1;
  KalmanBank bank(bare(), 16);
  KalmanBank other(forgetful, 16);
  bank.use(two_members());
  other.use(two_members());
  double apart = 0.0;
  for (const double sample : simulated(lively(), kSamples, 9)) {
    const core::BankEstimates answer = bank.step(sample);
    const core::BankEstimates forgotten = other.step(sample);
    ASSERT_EQ(answer.realtime.rate, forgotten.realtime.rate);
    apart = std::max(apart, std::abs(answer.denoised.rate - forgotten.denoised.rate));
  }
  EXPECT_GT(apart, 1e-3);
}

// However far off, one sample takes no more than most_evidence off a member's weight: off by a hundred or by ten thousand is the same.
TEST(Hindsight, OneSampleDoesNotDecideAlone) {
  JointOptions options = bare();
  options.most_evidence = 0.01;
  const auto share = [&options](double off) {
    Signal z = simulated(blocks(), kSamples, 4);
    z[kSamples - 17] += off;
    const auto then = static_cast<Eigen::Index>(kSamples - 17);
    const double first = Batch(blocks(), z).mean(then);
    const double second = Batch(lively(), z).mean(then);
    return (answer_of(options, 16, z) - first) / (second - first);
  };
  EXPECT_GT(share(1e2), 0.01);
  EXPECT_NEAR(share(1e2), share(1e4), 0.01);
}

// A bank that answers at once looks at nothing in hindsight: the later answers that it compares its own with weigh members by what innovations have
// said, of every sample.
TEST(Hindsight, OfABankThatAnswersAtOnceIsWhatInnovationsSay) {
  constexpr std::size_t kLater = KalmanBank::kLeastLater;
  JointOptions options = bare();
  options.most_later_gain = options.most_later_loss = 0.3;
  options.later_memory = 64.0;
  JointModel model = two_members();
  KalmanBank bank(options, 0);
  KalmanBank mixed(bare(), 0);
  KalmanBank calm(bare(), kLater);
  KalmanBank quick(bare(), kLater);
  bank.use(model);
  mixed.use(model);
  calm.use(single(blocks()));
  quick.use(single(lively()));
  core::LaterGain expected;
  Signal answers;
  const Signal z = simulated(lively(), 600, 4);
  for (std::size_t t = 0; t < z.size(); ++t) {
    answers.push_back(mixed.step(z[t]).realtime.rate);
    const core::BankEstimates a = calm.step(z[t]);
    const core::BankEstimates b = quick.step(z[t]);
    ASSERT_NEAR(bank.step(z[t]).realtime.rate, expected.apply(answers[t], 0.0, options, {}), 1e-6) << t;
    if (t < kLater) continue;
    const double weight = (answers[t] - b.realtime.rate) / (a.realtime.rate - b.realtime.rate);
    const double later = b.denoised.rate + weight * (a.denoised.rate - b.denoised.rate);
    expected.compare(later, answers[t - kLater], options, {});
  }
}

}  // namespace
}  // namespace gyrod
