// The bank against the conditional mean of a whole record, which is computed from covariances alone.
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "unit/core/joint/bank_batch.hpp"
#include "unit/core/joint/bank_support.hpp"

namespace gyrod {
namespace {

using core::BankEstimate;
using core::BankEstimates;
using core::BlockSet;
using core::FilterBlock;
using core::JointModel;
using core::JointOptions;
using core::KalmanBank;
using core::MemberKind;
using testing::autocovariance;
using testing::bare;
using testing::Batch;
using testing::blocks;
using testing::kBankNoise;
using testing::Signal;
using testing::simulated;
using testing::single;
constexpr std::size_t kSamples = 200;

/// What the bank answers to the last sample of z.
BankEstimates run_over(KalmanBank& bank, const BlockSet& set, const Signal& z) {
  bank.use(single(set));
  BankEstimates last;
  for (const double sample : z) last = bank.step(sample);
  return last;
}

void expect_last_answers_of(const Batch& batch, const BankEstimates& last) {
  EXPECT_NEAR(last.realtime.rate, batch.mean(kSamples - 1), 1e-8);
  EXPECT_NEAR(last.realtime.variance, batch.variance(kSamples - 1), 1e-8);
  EXPECT_NEAR(last.denoised.rate, batch.mean(kSamples - 1 - core::kMaxLag), 1e-8);
  EXPECT_NEAR(last.denoised.variance, batch.variance(kSamples - 1 - core::kMaxLag), 1e-8);
}

// After 200 samples nothing is left of the start (the closed loop's slowest pole is at 0.75), and the steady-state filter is the
// conditional mean. 1e-8: conditioning of 200 x 200 covariances.
TEST(KalmanBank, EqualsTheConditionalMeanOfTheWholeRecord) {
  const BlockSet set = blocks();
  const Signal z = simulated(set, kSamples, 1);
  const Batch batch(set, z);
  KalmanBank bank(bare(), core::kMaxLag);
  expect_last_answers_of(batch, run_over(bank, set, z));
  for (std::size_t age = 0; age <= core::kMaxLag; ++age) {
    const auto then = static_cast<Eigen::Index>(kSamples - 1 - age);
    EXPECT_NEAR(bank.held(age).rate, batch.mean(then), 1e-8) << age;
    EXPECT_NEAR(bank.held(age).variance, batch.variance(then), 1e-8) << age;
  }
}

// A process of which only a part is signal is two processes of the same spectrum, one of them noise.
TEST(KalmanBank, GivesOfASharedProcessTheSignalsPart) {
  BlockSet set = blocks();
  FilterBlock& shared = set.blocks[0];
  shared.signal = 0.6;
  shared.apart = 0.6 * 0.4 * autocovariance(shared, 1)[0];
  const Signal z = simulated(set, kSamples, 3);
  const Batch batch(set, z);
  KalmanBank bank(bare(), core::kMaxLag);
  expect_last_answers_of(batch, run_over(bank, set, z));
}

// The mean is the members' zero: shifting both shifts the answer.
TEST(KalmanBank, CountsFromTheModelsMean) {
  const BlockSet set = blocks();
  const Signal z = simulated(set, 100, 2);
  KalmanBank plain(bare(), 8);
  KalmanBank shifted(bare(), 8);
  plain.use(single(set));
  shifted.use(single(set, 5.0));
  for (const double sample : z) {
    const BankEstimates a = plain.step(sample);
    const BankEstimates b = shifted.step(sample + 5.0);
    EXPECT_NEAR(b.realtime.rate, a.realtime.rate + 5.0, 1e-12);
    EXPECT_NEAR(b.denoised.variance, a.denoised.variance, 1e-12);
  }
}

// A model that is handed over answers as if it had run over the last hand_over samples from zero.
TEST(KalmanBank, ANewModelRunsOverTheLastSamplesFirst) {
  const BlockSet set = blocks();
  const JointOptions options = bare();
  const Signal z = simulated(set, 600, 3);
  KalmanBank handed(options, 16);
  KalmanBank from_start(options, 16);
  from_start.use(single(set));
  for (std::size_t t = 0; t < 500; ++t) {
    handed.step(z[t]);
    if (t >= 500 - options.hand_over_samples) from_start.step(z[t]);
  }
  handed.use(single(set));
  for (std::size_t t = 500; t < z.size(); ++t) {
    const BankEstimates a = handed.step(z[t]);
    const BankEstimates b = from_start.step(z[t]);
    EXPECT_EQ(a.realtime.rate, b.realtime.rate);
    EXPECT_EQ(a.denoised.rate, b.denoised.rate);
    EXPECT_EQ(a.denoised.variance, b.denoised.variance);
  }
}

TEST(KalmanBank, IgnoresAModelThatIsNotUsable) {
  KalmanBank with(bare(), 16);
  KalmanBank without(bare(), 16);
  for (const double sample : testing::white_noise(100, 4)) {
    with.use(JointModel{});
    EXPECT_EQ(with.step(sample).realtime.rate, without.step(sample).realtime.rate);
  }
}

TEST(KalmanBank, ItsInnovationsAreNormalWhereTheModelIsRight) {
  const BlockSet set = blocks();
  KalmanBank bank(bare(), 16);
  bank.use(single(set));
  for (const double sample : simulated(set, 5000, 6)) bank.step(sample);
  // Mean of about 2 kFitMemory squares of normals: a deviation of sqrt(2 / 512) = 0.06.
  EXPECT_NEAR(bank.normalised_innovation(), 1.0, 0.25);
}

TEST(KalmanBank, ResetGivesTheBitsOfAFreshOne) {
  const BlockSet set = blocks();
  const Signal z = simulated(set, 300, 7);
  KalmanBank used({}, 16);
  KalmanBank fresh({}, 16);
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 100) used.use(single(set));
    used.step(1e3 * z[t]);
  }
  used.reset();
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 200) used.use(single(set));
    if (t == 200) fresh.use(single(set));
    const BankEstimates a = used.step(z[t]);
    const BankEstimates b = fresh.step(z[t]);
    EXPECT_EQ(a.realtime.rate, b.realtime.rate) << t;
    EXPECT_EQ(a.denoised.rate, b.denoised.rate) << t;
    EXPECT_EQ(a.denoised.variance, b.denoised.variance) << t;
    EXPECT_EQ(used.normalised_innovation(), fresh.normalised_innovation()) << t;
  }
}

TEST(KalmanBank, BeforeTheFirstModelLocalLevelsAnswer) {
  KalmanBank constant({}, 16);
  for (int t = 0; t < 100; ++t) EXPECT_NEAR(constant.step(3.0).realtime.rate, 3.0, 1e-12);
  KalmanBank noisy({}, 16);
  double squares = 0.0;
  const Signal z = testing::white_noise(2000, 8);
  for (std::size_t t = 0; t < z.size(); ++t) {
    const double error = noisy.step(z[t] + 3.0).realtime.rate - 3.0;
    if (t >= 100) squares += error * error / static_cast<double>(z.size() - 100);
  }
  // The calmest level alone leaves K / (2 - K) = 0.005 of the variance; the others and the start cost the rest.
  EXPECT_LT(squares, 0.1);
}

TEST(KalmanBank, AllocatesNothingAfterConstruction) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const JointModel model = single(blocks());
  const Signal z = testing::white_noise(600, 9);
  KalmanBank bank({}, 16);
  double sum = 0.0;
  const auto before = testing::allocations();
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 300) bank.use(model);
    sum += bank.step(z[t]).denoised.rate + bank.held(0).rate;
  }
  bank.reset();
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(std::isfinite(sum));
}

static_assert(noexcept(std::declval<KalmanBank&>().step(0.0)) && noexcept(
    std::declval<KalmanBank&>().use(std::declval<const JointModel&>())));

}  // namespace
}  // namespace gyrod
