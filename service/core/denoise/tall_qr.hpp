/// Least squares with many rows and few columns, in little memory.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// Columns that can be asked for: all lags of a series and of its innovations, and the series itself.
inline constexpr std::size_t kMaxRegressionColumns = kMaxArOrder + kMaxMaOrder + 1;

using RegressionMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRegressionColumns, kMaxRegressionColumns>;
using RegressionVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRegressionColumns, 1>;

/// The triangular factor R of a Householder factorisation [X | y] = Q R, taken in block by block: each block is folded into the R of
/// those before it. It is as stable as factorising all rows at once, never forms X'X, and holds one block of rows only.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
/// Source: Golub, Van Loan, "Matrix Computations", section 5.2 and 12.5 (updating QR).
///
///     qr.start(columns);
///     while (rows left) { fill qr.column(0..columns-1)[0..n); qr.absorb(n); }   // y is the last column
///     use(qr.factor());
class TallQr {
 public:
  static constexpr std::size_t kBlockRows = 512;

  /// @pre max_columns <= kMaxRegressionColumns
  explicit TallQr(std::size_t max_columns);

  /// Forgets all rows. @pre columns <= max_columns
  void start(std::size_t columns) noexcept;
  /// Where the next block's rows of one column go: kBlockRows of them.
  [[nodiscard]] std::span<double> column(std::size_t index) noexcept;
  /// Takes in the first n rows of the block; the block is overwritten. @pre n <= kBlockRows
  void absorb(std::size_t n) noexcept;
  /// R, columns x columns, upper triangular.
  [[nodiscard]] const RegressionMatrix& factor() const noexcept { return factor_; }

 private:
  std::vector<double> block_;  ///< column-major
  RegressionMatrix factor_;
};

struct LeastSquares {
  /// The columns are independent to rounding; else the rest means nothing.
  bool regular = false;
  RegressionVector coefficients;
  /// Roots of the diagonal of (X'X)^-1: times the residuals' standard deviation they are the standard errors.
  RegressionVector unit_errors;
  double residual_sum = 0.0;  ///< of squares
};

/// Regression of the last column of [X | y] on some of the others.
/// @param factor  R of [X | y]
/// @param columns indices of the columns of X to use, fewer than R has. None: residual_sum is y'y
/// Allocates nothing.
[[nodiscard]] LeastSquares least_squares(const RegressionMatrix& factor,
                                         std::span<const std::size_t> columns) noexcept;

}  // namespace gyrod::core
