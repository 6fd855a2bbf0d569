#include "core/evaluation/butterworth.hpp"

#include <algorithm>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

/// |H| at a frequency in cycles per sample, from the coefficients.
double gain(const std::vector<FilterSection>& sections, double frequency) {
  const std::complex<double> z = std::polar(1.0, -2.0 * std::numbers::pi * frequency);
  std::complex<double> h = 1.0;
  for (const FilterSection& s : sections) h *= (s.b0 + (s.b1 + s.b2 * z) * z) / (1.0 + (s.a1 + s.a2 * z) * z);
  return std::abs(h);
}

// Table values: scipy.signal.butter(1, 0.2), butter(2, 0.2) and butter(4, 0.2), seven digits; cut-off 0.1 cycles per sample.
TEST(Butterworth, HasThePublishedCoefficientsOfTheFirstOrder) {
  const auto s = butterworth(1, 0.1);
  ASSERT_EQ(s.size(), 1U);
  EXPECT_NEAR(s[0].b0, 0.2452373, 5e-8);
  EXPECT_NEAR(s[0].b1, 0.2452373, 5e-8);
  EXPECT_NEAR(s[0].a1, -0.5095254, 5e-8);
}

TEST(Butterworth, HasThePublishedCoefficientsOfTheSecondOrder) {
  const auto s = butterworth(2, 0.1);
  ASSERT_EQ(s.size(), 1U);
  EXPECT_NEAR(s[0].b0, 0.0674553, 5e-8);
  EXPECT_NEAR(s[0].b1, 0.1349105, 6e-8);
  EXPECT_NEAR(s[0].b2, 0.0674553, 5e-8);
  EXPECT_NEAR(s[0].a1, -1.1429805, 5e-8);
  EXPECT_NEAR(s[0].a2, 0.4128016, 5e-8);
}

TEST(Butterworth, HasThePublishedDenominatorOfTheFourthOrder) {
  const auto s = butterworth(4, 0.1);
  ASSERT_EQ(s.size(), 2U);
  EXPECT_NEAR(s[0].b0 * s[1].b0, 0.0048243, 5e-8);
  EXPECT_NEAR(s[0].a1 + s[1].a1, -2.3695130, 5e-8);
  EXPECT_NEAR(s[0].a2 + s[0].a1 * s[1].a1 + s[1].a2, 2.3139884, 5e-8);
  EXPECT_NEAR(s[0].a1 * s[1].a2 + s[0].a2 * s[1].a1, -1.0546654, 5e-8);
  EXPECT_NEAR(s[0].a2 * s[1].a2, 0.1873795, 5e-8);
}

TEST(Butterworth, LosesThreeDecibelsAtTheCutOffAndNothingAtRest) {
  for (const std::size_t order : {1U, 2U, 3U, 4U}) {
    for (const double cutoff : {1e-4, 0.01, 0.25, 0.49}) {
      const auto sections = butterworth(order, cutoff);
      EXPECT_NEAR(gain(sections, cutoff), std::sqrt(0.5), 1e-9) << order << ' ' << cutoff;
      EXPECT_NEAR(gain(sections, 0.0), 1.0, 1e-7)
          << order << ' ' << cutoff;  // b0 = 1e-7 at the lowest: rounding
    }
  }
}

// The header's formula of |H|.
TEST(Butterworth, HasTheGainOfItsFormula) {
  for (const std::size_t order : {1U, 2U, 4U}) {
    const double ratio = std::tan(std::numbers::pi * 0.2) / std::tan(std::numbers::pi * 0.07);
    const double expected = 1.0 / std::sqrt(1.0 + std::pow(ratio, 2.0 * static_cast<double>(order)));
    EXPECT_NEAR(gain(butterworth(order, 0.07), 0.2), expected, 1e-12);
  }
}

TEST(Butterworth, DoesNotRingAfterAnOffset) {
  std::vector<double> x(200, 7.5);
  filter_forward(butterworth(4, 0.03), x);
  EXPECT_THAT(x, testing::Each(testing::DoubleNear(7.5, 1e-9)));
}

TEST(ZeroPhase, LeavesAToneInPlaceWithTheSquaredGain) {
  const auto x = test::tone(4000, 0.02);
  const auto sections = butterworth(2, 0.03);
  const auto y = filter_zero_phase(sections, 0.03, x);
  const double squared = gain(sections, 0.02) * gain(sections, 0.02);
  for (std::size_t t = 500; t < 3500; ++t) ASSERT_NEAR(y[t], squared * x[t], 1e-6);
}

TEST(ZeroPhase, IsTheSameBackwardInTime) {
  auto x = test::random_walk(3000, 1.0, 5);
  const auto sections = butterworth(2, 0.05);
  auto forward = filter_zero_phase(sections, 0.05, x);
  std::ranges::reverse(x);
  auto backward = filter_zero_phase(sections, 0.05, x);
  std::ranges::reverse(backward);
  // Not bit for bit: what rings beyond the ends is cut off at one end first.
  for (std::size_t t = 200; t < 2800; ++t) ASSERT_NEAR(forward[t], backward[t], 1e-6);
}

TEST(ZeroPhase, FollowsARampUpToBothEnds) {
  std::vector<double> ramp(1000);
  for (std::size_t t = 0; t < ramp.size(); ++t) ramp[t] = 3.0 + 0.01 * static_cast<double>(t);
  const auto y = filter_zero_phase(butterworth(2, 0.02), 0.02, ramp);
  for (std::size_t t = 0; t < ramp.size(); ++t) ASSERT_NEAR(y[t], ramp[t], 0.01) << t;
}

TEST(ZeroPhase, TakesASeriesShorterThanItsPadding) {
  const std::vector<double> two = {1.0, 1.0};
  EXPECT_THAT(filter_zero_phase(butterworth(2, 0.001), 0.001, two),
              testing::Each(testing::DoubleNear(1.0, 1e-9)));
  EXPECT_TRUE(filter_zero_phase(butterworth(2, 0.001), 0.001, {}).empty());
}

}  // namespace
}  // namespace gyrod::core
