// The conditions of Kuhn and Tucker, which the solution and no other point meets.
#include "core/allan/nonnegative_least_squares.hpp"

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::nonnegative_least_squares;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr unsigned kAll = 31;

MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  const auto noise = testing::white_noise(static_cast<std::size_t>(rows * columns), seed);
  return Eigen::Map<const MatrixXd>(noise.data(), rows, columns);
}

TEST(NonnegativeLeastSquares, SolvesExactlyWhereTheAnswerIsPositive) {
  const MatrixXd a = random_matrix(20, 5, 1);
  const VectorXd truth = VectorXd::LinSpaced(5, 1.0, 3.0);
  EXPECT_NEAR((nonnegative_least_squares(a, a * truth, kAll) - truth).norm(), 0.0, 1e-12);
}

// Lawson, Hanson, theorem 23.4: x >= 0; the gradient g = A'(b - A x) is 0 where x > 0 and not above 0 elsewhere.
TEST(NonnegativeLeastSquares, MeetsTheConditionsOfAMinimum) {
  int zeros = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const MatrixXd a = random_matrix(12, 5, 2 * seed);
    const VectorXd b = random_matrix(12, 1, 2 * seed + 1);
    const VectorXd x = nonnegative_least_squares(a, b, kAll);
    const VectorXd gradient = a.transpose() * (b - a * x);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      EXPECT_GE(x(i), 0.0);
      EXPECT_GE(gradient(i), x(i) > 0.0 ? -1e-11 : gradient(i));
      EXPECT_LE(gradient(i), 1e-11);
      if (x(i) == 0.0) ++zeros;
    }
  }
  EXPECT_GT(zeros, 200) << "or the bound was never felt";
}

TEST(NonnegativeLeastSquares, LeavesOutWhatIsNotAllowed) {
  const MatrixXd a = random_matrix(20, 5, 3);
  const VectorXd x = nonnegative_least_squares(a, a * VectorXd::Ones(5), 0b01010);
  EXPECT_EQ(x(0), 0.0);
  EXPECT_EQ(x(2), 0.0);
  EXPECT_EQ(x(4), 0.0);
  EXPECT_EQ(nonnegative_least_squares(a, a * VectorXd::Ones(5), 0).norm(), 0.0);
}

TEST(NonnegativeLeastSquares, TakesColumnsOfVeryDifferentSize) {
  MatrixXd a = random_matrix(20, 5, 4).cwiseAbs();
  const VectorXd scale =
      VectorXd::LinSpaced(5, -8.0, 8.0).unaryExpr([](double e) { return std::pow(10.0, e); });
  const VectorXd truth = scale.cwiseInverse();
  a = a * scale.asDiagonal();
  const VectorXd x = nonnegative_least_squares(a, a * truth, kAll);
  EXPECT_NEAR((x.cwiseQuotient(truth) - VectorXd::Ones(5)).norm(), 0.0, 1e-11);
}

TEST(NonnegativeLeastSquares, IsZeroWhereEveryColumnPointsAway) {
  const MatrixXd a = random_matrix(6, 5, 5).cwiseAbs();
  EXPECT_EQ(nonnegative_least_squares(a, -VectorXd::Ones(6), kAll).norm(), 0.0);
}

TEST(NonnegativeLeastSquares, UsesNoMoreColumnsThanThereAreRows) {
  const MatrixXd a = random_matrix(2, 5, 6).cwiseAbs();
  const VectorXd x = nonnegative_least_squares(a, VectorXd::Ones(2), kAll);
  EXPECT_LE((x.array() > 0.0).count(), 2);
  EXPECT_TRUE(x.allFinite());
}

}  // namespace
}  // namespace gyrod
