/// Linear least squares with coefficients that cannot be negative.
#pragma once

#include <Eigen/Core>

namespace gyrod::core {

/// min |A x - b|^2 subject to x >= 0, and x_i = 0 where bit i of `allowed` is not set.
/// The solution is the ordinary one on the columns where it is positive: of all sets of columns whose ordinary
/// solution is positive, that with the least residual is taken. All 2^n - 1 sets are tried, 31 for five columns,
/// so there is no iteration that could stop early; the result is that of Lawson and Hanson's algorithm.
/// Columns are scaled to length 1 inside. Sets with more columns than rows, or dependent ones, are passed over.
/// @param a  rows x n, n <= 8, finite  @return x; all 0 where no set has a positive solution
/// Source: Lawson, Hanson, "Solving Least Squares Problems", 1974, chapter 23: the conditions met.
[[nodiscard]] Eigen::VectorXd nonnegative_least_squares(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                                        const Eigen::Ref<const Eigen::VectorXd>& b,
                                                        unsigned allowed);

}  // namespace gyrod::core
