#include "core/joint/member_model.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

BlockSet one_block(double pole, double drive) {
  BlockSet set;
  set.add({.order = 1, .a = {pole}, .drive = drive, .signal = 1.0});
  return set;
}

TEST(MemberDesigner, MeetsTheScalarRiccatiEquation) {
  // AR(1) in white noise: X = a^2 X r / (X + r) + q, K = X / (X + r); here a = 0.9, q = 0.5, r = 2.
  const double a = 0.9;
  const double q = 0.5;
  const double r = 2.0;
  const double b = r * (1.0 - a * a) - q;
  const double X = 0.5 * (-b + std::sqrt(b * b + 4.0 * q * r));
  MemberModel member;
  ASSERT_TRUE(MemberDesigner().design(one_block(a, q), r, member));
  EXPECT_NEAR(member.gain[0], X / (X + r), 1e-12);
  EXPECT_NEAR(member.innovation_variance, X + r, 1e-12);
  EXPECT_NEAR(member.prediction_variance, X, 1e-12);
}

TEST(MemberDesigner, SmoothsALevelWithTheClosedFormGains) {
  // g_k = K (a (1 - K))^k for one pole.
  const double a = 0.9;
  MemberModel member;
  ASSERT_TRUE(MemberDesigner().design(one_block(a, 0.5), 2.0, member));
  const double K = member.gain[0];
  for (std::size_t k = 0; k <= kMaxLag; ++k) {
    EXPECT_NEAR(member.smoothing[k], K * std::pow(a * (1.0 - K), static_cast<double>(k)), 1e-12);
  }
}

// Colour is smoothed as a level is, though it is no part of the signal.
TEST(MemberDesigner, SmoothsAllThatIsNotWhite) {
  const double a = 0.9;
  BlockSet colour = one_block(a, 0.5);
  colour.blocks[0].signal = 0.0;
  MemberModel member;
  ASSERT_TRUE(MemberDesigner().design(colour, 2.0, member));
  EXPECT_EQ(member.white_variance, 2.0);
  const double K = member.gain[0];
  for (std::size_t k = 0; k <= kMaxLag; ++k) {
    EXPECT_EQ(member.smoothing[k], 0.0);
    EXPECT_NEAR(member.whole_smoothing[k], K * std::pow(a * (1.0 - K), static_cast<double>(k)), 1e-12);
  }
}

TEST(MemberDesigner, LeavesTheMemberAloneWhereItFails) {
  MemberModel member;
  member.states = 7;
  EXPECT_FALSE(MemberDesigner().design(one_block(0.9, std::nan("")), 2.0, member));
  EXPECT_EQ(member.states, 7U);
  EXPECT_FALSE(member.usable);
}

// What rounding leaves below zero is no variance.
TEST(MemberModel, HasNoVarianceBelowZero) {
  MemberModel member;
  member.innovation_variance = 2.0;
  member.prediction_variance = 2.0;
  member.smoothing = {0.6, 0.6, 1.0};
  EXPECT_NEAR(member.error_variance(0), 2.0 - 0.72, 1e-15);
  EXPECT_NEAR(member.error_variance(1), 2.0 - 1.44, 1e-15);
  EXPECT_EQ(member.error_variance(2), 0.0);
}

}  // namespace
}  // namespace gyrod::core
