// The low-pass, and the bank's answers within a band against the conditional mean that covariances alone give.
#include "core/joint/signal_band.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>

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
using core::KalmanBank;
using core::kMaxLag;
using core::SignalBand;
using core::SignalBandLimit;
using testing::bare;
using testing::blocks;
using testing::kBankNoise;
using testing::Signal;

SignalBand band_of(double cycles) {
  SignalBand band;
  band.set(cycles);
  return band;
}

TEST(SignalBand, PassesWhatIsBelowAndNothingAbove) {
  for (const double cycles : {0.02, 0.05, 0.11, 0.3, 0.44}) {
    const SignalBand band = band_of(cycles);
    ASSERT_TRUE(band.limits());
    EXPECT_NEAR(std::accumulate(band.taps().begin(), band.taps().end(), 0.0), 1.0, 1e-12);
    for (const double part : {0.0, 0.3, 0.6, 0.9})
      EXPECT_NEAR(band.gain(part * cycles), 1.0, 0.005) << cycles;
    EXPECT_NEAR(band.gain(band.cycles()), 0.5, 0.005);
    for (double above = 1.1 * cycles; above < 0.5; above += 0.01)
      EXPECT_NEAR(band.gain(above), 0.0, 0.005) << cycles;
    EXPECT_EQ(band.tap(3), band.tap(-3));
    EXPECT_EQ(band.tap(static_cast<std::ptrdiff_t>(band.reach()) + 1), 0.0);
  }
}

TEST(SignalBand, IsTheSameForRatesThatAreEstimatedAnew) {
  EXPECT_NEAR(band_of(0.0417).cycles(), 0.0417, 0.001 * 0.0417);
  EXPECT_EQ(band_of(0.04170).cycles(), band_of(0.04171).cycles());
  EXPECT_NE(band_of(0.0417).cycles(), band_of(0.0419).cycles());
}

TEST(SignalBand, LimitsNothingFromHalfTheSampleRateOn) {
  for (const double cycles : {0.5, 0.4999, 1.0, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const SignalBand band = band_of(cycles);
    EXPECT_FALSE(band.limits()) << cycles;
    EXPECT_EQ(band.gain(0.3), 1.0) << cycles;
  }
}

TEST(SignalBand, IsAsLongAsThereIsRoomForALowLimit) {
  const SignalBand band = band_of(0.002);
  EXPECT_EQ(band.reach(), SignalBand::kMaxReach);
  EXPECT_NEAR(band.gain(0.0), 1.0, 1e-12);
  EXPECT_NEAR(band.gain(0.006), 0.0, 0.01);
}

/// E[d[t-age] | z[..t]] and its error's variance, d the low-passed signal: from covariances of s[t-age+j] with all samples, j up to the band's reach,
/// past the end of the record.
struct BandBatch {
  BandBatch(const BlockSet& set, const Signal& z, const SignalBand& band)
      : band_(band),
        signal_(testing::autocovariance(set, z.size() + 2 * band.reach() + 1, true)),
        solver_(testing::sample_covariance(set, z.size())),
        weighted_(
            solver_.solve(Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size())))) {
  }

  [[nodiscard]] BankEstimate at(std::size_t age) const {
    const Eigen::Index n = weighted_.size();
    const auto reach = static_cast<Eigen::Index>(band_.reach());
    const Eigen::Index then = n - 1 - static_cast<Eigen::Index>(age);
    Eigen::VectorXd c = Eigen::VectorXd::Zero(n);
    double whole = 0.0;
    for (Eigen::Index j = -reach; j <= reach; ++j) {
      for (Eigen::Index i = 0; i < n; ++i)
        c(i) += band_.tap(j) * signal_[static_cast<std::size_t>(std::abs(then + j - i))];
      for (Eigen::Index i = -reach; i <= reach; ++i)
        whole += band_.tap(j) * band_.tap(i) * signal_[static_cast<std::size_t>(std::abs(j - i))];
    }
    return {.rate = c.dot(weighted_), .variance = whole - c.dot(solver_.solve(c))};
  }

 private:
  SignalBand band_;
  Signal signal_;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
  Eigen::VectorXd weighted_;
};

core::JointModel banded(const BlockSet& set, double cycles, double mean = 0.0) {
  core::JointModel model;
  core::MemberDesigner designer;
  designer.set_band(cycles);
  EXPECT_TRUE(designer.design(set, kBankNoise, model.member(core::MemberKind::kFull)));
  model.band_cycles = designer.band_cycles();
  model.mean = mean;
  return model;
}

void expect_conditional_means(const BlockSet& set, double cycles, std::size_t lag, double tolerance) {
  constexpr std::size_t kSamples = 700;
  const Signal z = testing::simulated(set, kSamples, 1);
  const BandBatch batch(set, z, band_of(cycles));
  KalmanBank bank(bare(), lag, SignalBandLimit::kPossible);
  bank.use(banded(set, cycles));
  BankEstimates last;
  for (const double sample : z) last = bank.step(sample);
  const auto expect_same = [&](std::size_t age, const BankEstimate& answer) {
    const BankEstimate expected = batch.at(age);
    EXPECT_NEAR(answer.rate, expected.rate, tolerance) << cycles << ", age " << age;
    EXPECT_NEAR(answer.variance, expected.variance, 0.02 * expected.variance) << cycles << ", age " << age;
  };
  expect_same(0, last.realtime);
  expect_same(lag, last.denoised);
  for (std::size_t age = 0; age <= lag; age += 5) expect_same(age, bank.held(age));
}

// Rates to 1e-4 of a signal of deviation 2.4: samples older than kMaxLag are known with that look-ahead only, and the closed loop's slowest pole, 0.75,
// leaves 1e-4 of what is told later. Variances to 2 %: an integral over 256 frequencies, a sum in steps. The narrowest band reaches 500 samples, so that
// what is settled has gone round its ring.
TEST(KalmanBank, WithinABandEqualsTheConditionalMeanOfTheLowPassedSignal) {
  for (const double cycles : {0.016, 0.05, 0.1, 0.3})
    expect_conditional_means(blocks(), cycles, kMaxLag, 3e-4);
  expect_conditional_means(blocks(), 0.05, 16, 3e-4);
}

BlockSet slow_level() {
  BlockSet slow;
  slow.add({.order = 1, .a = {0.999}, .drive = 0.0003, .signal = 1.0});
  return slow;
}

// Beside strong noise a slow level is learned for longer than kMaxLag samples: the closed loop's pole is at 0.98, and half of what is told is told later. An
// answer lacks some hundredths of the deviation that is left.
TEST(KalmanBank, WithinABandKnowsHowWellItKnowsSlowMotion) {
  for (const double cycles : {0.016, 0.1, 0.45})
    expect_conditional_means(slow_level(), cycles, kMaxLag, 0.02);
}

// A band hardly asks for less than all of a signal that is slow.
TEST(MemberDesigner, KnowsASlowSignalWithinAWideBandAsWellAsWithoutOne) {
  const core::JointModel model = banded(slow_level(), 0.45);
  const core::MemberModel& member = model.member(core::MemberKind::kFull);
  for (const std::size_t lag : {std::size_t{0}, std::size_t{16}, kMaxLag})
    EXPECT_NEAR(member.band_variance[lag] / member.error_variance(lag), 1.0, 0.02) << lag;
}

// A sample rate that becomes known brings a band.
TEST(JointFit, MakesTheMembersOfAnotherBandAnew) {
  const Signal z = testing::sum(testing::white_noise(1024, 3), testing::tone(1024, 0.02), 2.0);
  core::JointModel model;
  core::WindowReport report;
  core::JointFit fit(1024);
  for (const double cycles : {0.5, 0.1, 0.2, 0.5}) {
    fit.set_max_signal(cycles);
    fit.fit(z, core::white_noise(1.0), model, report);
    ASSERT_TRUE(model.usable());
    EXPECT_EQ(model.band_cycles, band_of(cycles).cycles());
    for (const core::MemberModel& member : model.members)
      EXPECT_EQ(member.band_variance[0] > 0.0, cycles < 0.5) << cycles;
  }
}

TEST(KalmanBank, WithinABandKnowsTheMean) {
  KalmanBank bank(bare(), 16, SignalBandLimit::kPossible);
  bank.use(banded(blocks(), 0.05, 40.0));
  for (int t = 0; t < 300; ++t) {
    const BankEstimates answer = bank.step(40.0);
    EXPECT_NEAR(answer.realtime.rate, 40.0, 1e-9) << t << ", also where nothing is settled yet";
    EXPECT_NEAR(answer.denoised.rate, 40.0, 1e-9) << t;
  }
}

// The samples that are settled outlast the model that settled them.
TEST(KalmanBank, WithinABandGoesOnWhereTheSameModelComesAgain) {
  const Signal z = testing::simulated(blocks(), 600, 2);
  KalmanBank once(bare(), 16, SignalBandLimit::kPossible);
  KalmanBank again(bare(), 16, SignalBandLimit::kPossible);
  once.use(banded(blocks(), 0.05));
  again.use(banded(blocks(), 0.05));
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t == 500) again.use(banded(blocks(), 0.05));
    const BankEstimates expected = once.step(z[t]);
    const BankEstimates answer = again.step(z[t]);
    ASSERT_NEAR(answer.realtime.rate, expected.realtime.rate, 1e-9) << t;
    ASSERT_NEAR(answer.denoised.rate, expected.denoised.rate, 1e-9) << t;
  }
}

TEST(KalmanBank, WithRoomForABandIsTheSameWithoutOne) {
  const Signal z = testing::simulated(blocks(), 200, 2);
  KalmanBank none(bare(), 16);
  KalmanBank without(bare(), 16, SignalBandLimit::kPossible);
  none.use(banded(blocks(), 0.5));
  without.use(banded(blocks(), 0.5));
  for (const double sample : z)
    EXPECT_EQ(none.step(sample).denoised.rate, without.step(sample).denoised.rate);
}

TEST(KalmanBank, WithinABandBeginsAnewAfterAReset) {
  const Signal z = testing::simulated(blocks(), 300, 2);
  KalmanBank fresh(bare(), 16, SignalBandLimit::kPossible);
  KalmanBank again(bare(), 16, SignalBandLimit::kPossible);
  again.use(banded(blocks(), 0.02));
  for (const double sample : z) (void)again.step(sample + 50.0);
  again.reset();
  fresh.use(banded(blocks(), 0.05));
  again.use(banded(blocks(), 0.05));
  for (const double sample : z) EXPECT_EQ(again.step(sample).denoised.rate, fresh.step(sample).denoised.rate);
}

TEST(KalmanBank, WithinABandAllocatesNothing) {
  const core::JointModel model = banded(blocks(), 0.05);
  const Signal z = testing::simulated(blocks(), 200, 2);
  KalmanBank bank({}, 8, SignalBandLimit::kPossible);
  core::MemberDesigner designer;
  core::MemberModel member;
  if (!testing::counts_allocations()) GTEST_SKIP() << "a sanitizer's heap";
  const std::uint64_t before = testing::allocations();
  designer.set_band(0.05);
  EXPECT_TRUE(designer.design(blocks(), kBankNoise, member));
  for (const double sample : z) {
    bank.use(model);
    (void)bank.step(sample);
    if (bank.step(sample).denoised.rate != 0.0) (void)bank.held(3);
  }
  EXPECT_EQ(testing::allocations(), before);
}

// A road shakes at all frequencies from 0.04 to 0.16 cycles a sample: one wide mode, which is both below and above any limit between them. The
// least error is that of the true model.
TEST(JointFit, KnowsThePartOfAWideModeThatIsWithinTheBand) {
  constexpr std::size_t kSize = 6000;
  const FilterBlock road = testing::oscillation(0.9, 0.2 * std::numbers::pi, 0.8);
  BlockSet set;
  set.add(road);
  const Signal truth = testing::times(
      testing::autoregressive({road.a.begin(), road.a.begin() + static_cast<std::ptrdiff_t>(road.order)},
                              kSize, 5),
      std::sqrt(road.drive));
  const Signal z = testing::sum(truth, testing::times(testing::white_noise(kSize, 6), std::sqrt(kBankNoise)));
  for (const double cycles : {0.06, 0.1, 0.14}) {
    const testing::JointOutput out = testing::run_joint(z, core::white_noise(kBankNoise), 16, 64, cycles);
    const double error =
        testing::rms_difference(out.denoised, core::low_passed(truth, band_of(cycles)), 1500, 5500);
    const double least = std::sqrt(banded(set, cycles).member(core::MemberKind::kFull).band_variance[16]);
    EXPECT_LT(error, 1.1 * least) << cycles;
    EXPECT_GT(error, 0.9 * least) << cycles;
  }
}

}  // namespace
}  // namespace gyrod
