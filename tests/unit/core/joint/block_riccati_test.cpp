// The solution put back into its equation, and the same bits from every kernel.
#include "core/joint/block_riccati.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod {
namespace {

using core::BlockRiccati;
using core::BlockSet;
using core::EmdKernel;
using core::FilterBlock;

/// Blocks as fits give them: oscillations and a slow pole near the unit circle, AR(3), and a colour of order 8.
BlockSet random_blocks(unsigned seed, std::size_t modes, bool colour) {
  std::mt19937_64 bits(seed);
  std::uniform_real_distribution<double> uniform;
  BlockSet set;
  for (std::size_t j = 0; j < modes; ++j) {
    const double radius = 1.0 - std::pow(10.0, -0.5 - 3.0 * uniform(bits));
    FilterBlock block = testing::oscillation(radius, 3.0 * std::pow(uniform(bits), 2.0),
                                             std::pow(10.0, -4.0 * uniform(bits)));
    const double pole = 0.9 * uniform(bits);
    block.order = 3;
    block.a[2] = -pole * block.a[1];
    block.a[1] -= pole * block.a[0];
    block.a[0] += pole;
    set.add(block);
  }
  if (colour) set.add({.order = 8, .a = {0.3, 0.1, -0.1, 0.05, 0.0, 0.1, -0.2, 0.1}, .drive = 0.4});
  return set;
}

struct Matrices {
  Eigen::MatrixXd A, Q;
  Eigen::VectorXd H;
};

Matrices matrices_of(const BlockSet& set) {
  Eigen::Index size = 0;
  for (const FilterBlock& block : set.all()) size += static_cast<Eigen::Index>(block.order);
  Matrices m{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size),
             Eigen::VectorXd::Zero(size)};
  Eigen::Index head = 0;
  for (const FilterBlock& block : set.all()) {
    const auto order = static_cast<Eigen::Index>(block.order);
    for (Eigen::Index i = 0; i < order; ++i) m.A(head, head + i) = block.a[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 1; i < order; ++i) m.A(head + i, head + i - 1) = 1.0;
    m.Q(head, head) = block.drive;
    m.H(head) = 1.0;
    head += order;
  }
  return m;
}

Eigen::MatrixXd covariance_of(const BlockRiccati& riccati) {
  const auto size = static_cast<Eigen::Index>(riccati.observed_covariance().size());
  Eigen::MatrixXd X(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      X(i, j) = riccati.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
    }
  }
  return X;
}

class BlockRiccatiOf : public ::testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Random, BlockRiccatiOf, ::testing::Range(1U, 25U));

// X - A (X - X H H' X / S) A' - Q = 0. 1e-9 of X's norm: poles at 1 - 3e-4, three to a mode, condition it so.
TEST_P(BlockRiccatiOf, MeetsTheEquation) {
  const std::size_t modes = 1 + GetParam() % 10;
  const BlockSet set = random_blocks(GetParam(), modes, GetParam() % 2 == 0);
  for (const double r : {0.1, 1.0, 30.0}) {
    const auto riccati = std::make_unique<BlockRiccati>();
    ASSERT_TRUE(riccati->solve(set, r));
    const Matrices m = matrices_of(set);
    const Eigen::MatrixXd X = covariance_of(*riccati);
    const Eigen::VectorXd XH = X * m.H;
    const double S = m.H.dot(XH) + r;
    EXPECT_NEAR(riccati->innovation_variance(), S, 1e-12 * S);
    for (Eigen::Index i = 0; i < XH.size(); ++i) {
      EXPECT_NEAR(riccati->observed_covariance()[static_cast<std::size_t>(i)], XH(i), 1e-12 * X.norm());
    }
    const Eigen::MatrixXd next = m.A * (X - XH * XH.transpose() / S) * m.A.transpose() + m.Q;
    EXPECT_LE((next - X).norm(), 1e-9 * X.norm()) << r;
    EXPECT_EQ((X - X.transpose()).norm(), 0.0);
  }
}

TEST_P(BlockRiccatiOf, GivesTheSameBitsOnEveryKernel) {
  const BlockSet set = random_blocks(GetParam(), 1 + GetParam() % 10, true);
  const auto baseline = std::make_unique<BlockRiccati>(EmdKernel::kBaseline);
  ASSERT_TRUE(baseline->solve(set, 1.0));
  for (const EmdKernel kernel : {EmdKernel::kAvx2, EmdKernel::kAvx512, EmdKernel::kFastest}) {
    if (!core::is_available(kernel)) continue;
    const auto other = std::make_unique<BlockRiccati>(kernel);
    ASSERT_TRUE(other->solve(set, 1.0));
    EXPECT_EQ(covariance_of(*other), covariance_of(*baseline));
    EXPECT_EQ(other->innovation_variance(), baseline->innovation_variance());
  }
}

TEST(BlockRiccati, AUsedOneGivesTheBitsOfAFreshOne) {
  const BlockSet small = random_blocks(1, 2, false);
  const auto used = std::make_unique<BlockRiccati>();
  const auto fresh = std::make_unique<BlockRiccati>();
  ASSERT_TRUE(used->solve(random_blocks(2, 10, true), 1.0));
  ASSERT_TRUE(used->solve(small, 1.0));
  ASSERT_TRUE(fresh->solve(small, 1.0));
  EXPECT_EQ(covariance_of(*used), covariance_of(*fresh));
}

// Roots within 1e-6 of the unit circle: the doubling must go on for 2^20 samples and more.
TEST(BlockRiccati, SettlesForPolesNextToTheUnitCircle) {
  BlockSet set;
  set.add(testing::oscillation(1.0 - 1e-6, 0.01, 1e-10));
  const auto riccati = std::make_unique<BlockRiccati>();
  ASSERT_TRUE(riccati->solve(set, 1.0));
  const Matrices m = matrices_of(set);
  const Eigen::MatrixXd X = covariance_of(*riccati);
  const Eigen::VectorXd XH = X * m.H;
  const Eigen::MatrixXd next =
      m.A * (X - XH * XH.transpose() / riccati->innovation_variance()) * m.A.transpose() + m.Q;
  EXPECT_LE((next - X).norm(), 1e-10 * X.norm());
}

// Of drives 1e4 to 1e22 times as large as the noise: where rounding has eaten the answer it is refused, and what is given meets the
// equation in X H to 1e-2 of its largest element (refused is what misses it by 1e-3).
TEST(BlockRiccati, NeverGivesWhatDoesNotMeetTheEquation) {
  const auto riccati = std::make_unique<BlockRiccati>();
  int refused = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    BlockSet set = random_blocks(seed, 3 + seed % 5, false);
    const double ratio = std::pow(10.0, 4.0 + 0.3 * seed);
    for (FilterBlock& block : set.blocks) block.drive *= ratio;
    if (!riccati->solve(set, 1.0)) {
      ++refused;
      continue;
    }
    const Matrices m = matrices_of(set);
    const Eigen::MatrixXd X = covariance_of(*riccati);
    const Eigen::VectorXd XH = X * m.H;
    const Eigen::MatrixXd filtered = X - XH * XH.transpose() / riccati->innovation_variance();
    const Eigen::VectorXd next = (m.A * filtered * m.A.transpose() + m.Q) * m.H;
    EXPECT_LE((next - XH).cwiseAbs().maxCoeff(), 1e-2 * XH.cwiseAbs().maxCoeff()) << seed;
  }
  EXPECT_LT(refused, 60);
}

TEST(BlockRiccati, RefusesWhatIsNotFinite) {
  const auto riccati = std::make_unique<BlockRiccati>();
  BlockSet set;
  set.add({.order = 1, .a = {0.9}, .drive = std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(riccati->solve(set, 1.0));
  set.blocks[0] = {.order = 1, .a = {std::numeric_limits<double>::quiet_NaN()}, .drive = 1.0};
  EXPECT_FALSE(riccati->solve(set, 1.0));
}

TEST(BlockRiccati, AllocatesNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const auto riccati = std::make_unique<BlockRiccati>();
  const BlockSet set = random_blocks(3, 10, true);
  const auto before = testing::allocations();
  EXPECT_TRUE(riccati->solve(set, 1.0));
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace gyrod
