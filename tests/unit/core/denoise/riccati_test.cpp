// The Riccati equation against its scalar root, and with the answer put back in.
#include "core/denoise/riccati.hpp"

#include <array>

#include <gtest/gtest.h>

namespace gyrod {
namespace {

using core::StateMatrix;
using core::StateSpace;
using core::StateVector;

StateSpace scalar(double a, double q, double r) {
  StateSpace model;
  model.A = StateMatrix::Constant(1, 1, a);
  model.Q = StateMatrix::Constant(1, 1, q);
  model.h = StateVector::Constant(1, 1.0);
  model.r = r;
  return model;
}

// X = a^2 X r / (X + r) + q, that is X^2 - b X - q r = 0 with b = q - r (1 - a^2).
double scalar_root(double a, double q, double r) {
  const double b = q - r * (1.0 - a * a);
  const double root = std::sqrt(b * b + 4.0 * q * r);
  return b > 0.0 ? 0.5 * (b + root) : 2.0 * q * r / (root - b);
}

TEST(Riccati, OfOneStateIsTheRootOfTheQuadraticEquation) {
  for (const double a : {0.0, 0.3, -0.9, 0.999, 0.9999}) {
    for (const double q : {1e-8, 1e-4, 1.0, 1e4}) {
      for (const double r : {1e-3, 1.0, 1e3}) {
        StateMatrix x;
        ASSERT_TRUE(core::solve_riccati(scalar(a, q, r), x));
        const double expected = scalar_root(a, q, r);
        EXPECT_NEAR(x(0, 0), expected, 1e-12 * expected) << a << " " << q << " " << r;
      }
    }
  }
}

/// The companion form of an AR model whose state is seen in noise of variance 1.
StateSpace companion(const std::vector<double>& a, double q) {
  const auto p = static_cast<Eigen::Index>(a.size());
  StateSpace model;
  model.A.setZero(p, p);
  model.A.row(0) = Eigen::Map<const Eigen::RowVectorXd>(a.data(), p);
  model.A.bottomLeftCorner(p - 1, p - 1).setIdentity();
  model.Q.setZero(p, p);
  model.Q(0, 0) = q;
  model.h = StateVector::Unit(p, 0);
  model.r = 1.0;
  return model;
}

class RiccatiOfAr : public ::testing::TestWithParam<std::vector<double>> {};

INSTANTIATE_TEST_SUITE_P(Models, RiccatiOfAr,
                         ::testing::Values(std::vector{0.5, 0.2}, std::vector{1.6, -0.8},
                                           std::vector{2.76, -3.81, 2.65, -0.92},
                                           std::vector{0.8, -0.4, 0.3, -0.35, 0.2, -0.1}));

// X - A (X - X h h' X / (h' X h + r)) A' - Q = 0, and X is a covariance.
TEST_P(RiccatiOfAr, SolvesItsEquation) {
  for (const double q : {1e-6, 1e-2, 1.0, 100.0}) {
    const StateSpace model = companion(GetParam(), q);
    StateMatrix x;
    ASSERT_TRUE(core::solve_riccati(model, x)) << q;
    const Eigen::VectorXd xh = x * model.h;
    const Eigen::MatrixXd filtered = x - xh * xh.transpose() / (model.h.dot(xh) + model.r);
    const Eigen::MatrixXd residual = model.A * filtered * model.A.transpose() + model.Q - x;
    EXPECT_LE(residual.norm(), 1e-11 * x.norm()) << q;
    EXPECT_EQ((x - x.transpose()).norm(), 0.0);
    EXPECT_GE(x.diagonal().minCoeff(), 0.0);
  }
}

TEST(Riccati, WithoutStateNoiseIsZero) {
  StateMatrix x;
  ASSERT_TRUE(core::solve_riccati(scalar(0.9, 0.0, 1.0), x));
  EXPECT_EQ(x(0, 0), 0.0);
}

TEST(Riccati, SaysSoWhereThereIsNoAnswer) {
  StateMatrix x;
  EXPECT_FALSE(core::solve_riccati(scalar(std::nan(""), 1.0, 1.0), x));
  EXPECT_FALSE(core::solve_riccati(scalar(0.5, std::numeric_limits<double>::infinity(), 1.0), x));
}

}  // namespace
}  // namespace gyrod
