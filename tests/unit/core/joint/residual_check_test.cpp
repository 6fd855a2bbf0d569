// What an estimate took off a sample and the noise cannot have been.
#include "core/joint/residual_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/signals.hpp"
#include "unit/core/joint/bank_support.hpp"

namespace gyrod {
namespace {

using core::BankEstimate;
using core::JointOptions;
using core::ResidualCheck;
using testing::Signal;

constexpr double kNoise = 0.25;  // a deviation of 0.5
constexpr BankEstimate kEstimate{.rate = 3.0, .variance = 0.01};

constexpr double kNotKnown = std::numeric_limits<double>::infinity();

/// @param beside of the samples about it, deviations
BankEstimate seen(ResidualCheck& check, double deviations, double beside = kNotKnown) {
  const double sample = kEstimate.rate + deviations * std::sqrt(kNoise);
  return check.apply(sample, kEstimate, kNoise, beside * beside * kNoise, {});
}

TEST(ResidualCheck, LeavesAloneWhatNoiseCanBe) {
  ResidualCheck check;
  for (const double deviations : {0.0, 1.0, -1.2, -0.5, -3.9, 0.8}) {
    const BankEstimate answer = seen(check, deviations);
    EXPECT_EQ(answer.rate, kEstimate.rate) << deviations;
    EXPECT_EQ(answer.variance, kEstimate.variance) << deviations;
  }
}

// d = 10 deviations: w = 1 - 25 / 100. The estimate's own error is then about sqrt(d^2 - R), that of the sample R.
TEST(ResidualCheck, GivesBackWhatItCannotBe) {
  ResidualCheck check;
  const BankEstimate answer = seen(check, 10.0);
  EXPECT_NEAR(answer.rate, kEstimate.rate + 0.75 * 5.0, 1e-12);
  EXPECT_NEAR(answer.variance, kNoise * (0.25 * 0.25 * 99.0 + 0.75 * 0.75), 1e-12);
}

// Of 10 deviations beside 3 deviations (3 * 3 = 9 is less than 10) count 9: w = 1 - 25 / 81. Beside one deviation they count 3, which noise can be, and
// beside none 1; not in the mean, either.
TEST(ResidualCheck, DoesNotGiveBackASampleThatIsWrongByItself) {
  ResidualCheck check;
  EXPECT_NEAR(seen(check, 10.0, 3.0).rate, kEstimate.rate + (1.0 - 25.0 / 81.0) * 5.0, 1e-12);
  for (const double beside : {1.0, 0.0}) {
    ResidualCheck fresh;
    EXPECT_EQ(seen(fresh, 1e3, beside).rate, kEstimate.rate);
    EXPECT_EQ(seen(fresh, 1e3, beside).variance, kEstimate.variance);
    EXPECT_EQ(seen(fresh, 1.0).rate, kEstimate.rate) << "nor does it raise the mean beyond 2";
  }
}

TEST(ResidualCheck, GivesBackMoreTheFartherOffItIs) {
  for (const double deviations : {5.1, 6.0, 40.0, 1e3, 1e6}) {
    ResidualCheck check;
    const double left = deviations * std::sqrt(kNoise) - (seen(check, deviations).rate - kEstimate.rate);
    EXPECT_LE(left, 25.0 / deviations * std::sqrt(kNoise) * (1.0 + 1e-6)) << deviations;
    EXPECT_GE(left, 0.0) << deviations;
  }
}

// Two deviations are nothing once; all the time they are an estimate that is wrong by sqrt(3): m goes to 4, w to 1 - 2 / 4.
TEST(ResidualCheck, NoticesThatResidualsAreLargeForLong) {
  ResidualCheck check;
  EXPECT_EQ(seen(check, 2.0).rate, kEstimate.rate);
  BankEstimate answer;
  for (int t = 0; t < 500; ++t) answer = seen(check, t % 2 == 0 ? 2.0 : -2.0);
  EXPECT_NEAR(answer.rate, kEstimate.rate - 0.5, 1e-9);
  EXPECT_NEAR(answer.variance, kNoise * (0.25 * 3.0 + 0.25), 1e-9);
}

// However large: a hundredfold square is the most that counts in the mean, and 16 ln(100 / 16) samples wear it off.
TEST(ResidualCheck, ForgetsAKnock) {
  ResidualCheck check;
  seen(check, 1e9);
  int samples = 0;
  while (seen(check, 1.0).rate != kEstimate.rate) ASSERT_LT(++samples, 60);
  EXPECT_GT(samples, 5);
}

TEST(ResidualCheck, DoesNothingWhereAnythingMayBeLeftOut) {
  ResidualCheck check;
  for (const double variance : {0.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(check.apply(1e6, kEstimate, variance, kNotKnown, {}).rate, kEstimate.rate);
  }
}

TEST(ResidualCheck, StaysFinite) {
  ResidualCheck check;
  for (const double sample : std::array{1e300, -1e300, 0.0, 1e-300}) {
    for (const double variance : {1e-300, 1.0, 1e300}) {
      const BankEstimate answer = check.apply(sample, kEstimate, variance, kNotKnown, {});
      EXPECT_TRUE(std::isfinite(answer.rate)) << sample << ' ' << variance;
      EXPECT_FALSE(std::isnan(answer.variance)) << sample << ' ' << variance;
    }
  }
}

/// A bank of one member whose model knows the noise of testing::simulated.
core::JointModel model() {
  core::JointModel model = testing::single(testing::blocks());
  model.noise_variance = model.slow_noise_variance = testing::kBankNoise;
  model.residual_variance = testing::kBankNoise;
  return model;
}

// A knock of three samples: steady-state filters smear it over what comes before and after.
TEST(KalmanBank, AKnockDoesNotReachWhatComesBeforeAndAfterIt) {
  constexpr std::size_t kKnock = 300;
  constexpr std::size_t kLag = 8;
  Signal z = testing::simulated(testing::blocks(), 600, 9);
  for (std::size_t t = 0; t < 3; ++t) z[kKnock + t] += t == 1 ? -400.0 : 300.0;
  const double bound = 5.0 * std::sqrt(testing::kBankNoise);
  core::KalmanBank bank(testing::bare(), kLag);
  JointOptions trusting = testing::bare();
  trusting.residual_limit = trusting.residual_mean_limit = 1e12;
  core::KalmanBank without(trusting, kLag);
  bank.use(model());
  without.use(model());
  double farthest = 0.0;
  double farthest_without = 0.0;
  for (std::size_t t = 0; t < z.size(); ++t) {
    const double answer = bank.step(z[t]).denoised.rate;
    const double unchecked = without.step(z[t]).denoised.rate;
    if (t < kLag) continue;
    farthest = std::max(farthest, std::abs(z[t - kLag] - answer));
    if (t - kLag < kKnock || t - kLag > kKnock + 2)
      farthest_without = std::max(farthest_without, std::abs(z[t - kLag] - unchecked));
  }
  EXPECT_LE(farthest, bound * (1.0 + 1e-12));
  EXPECT_GT(farthest_without, 5.0 * bound) << "the knock is smeared where nothing is checked";
  for (std::size_t age = 0; age < kLag; ++age) {
    EXPECT_LE(std::abs(z[z.size() - 1 - age] - bank.held(age).rate), bound * (1.0 + 1e-12)) << age;
  }
}

// What drains at the end of a record is checked, too.
TEST(KalmanBank, WhatIsHeldIsCheckedToo) {
  Signal z = testing::simulated(testing::blocks(), 300, 9);
  z.back() += 500.0;
  core::KalmanBank bank(testing::bare(), 8);
  bank.use(model());
  for (const double sample : z) bank.step(sample);
  for (std::size_t age = 0; age < 8; ++age) {
    EXPECT_LE(std::abs(z[z.size() - 1 - age] - bank.held(age).rate),
              5.0 * std::sqrt(testing::kBankNoise) * (1.0 + 1e-12))
        << age;
  }
}

}  // namespace
}  // namespace gyrod
