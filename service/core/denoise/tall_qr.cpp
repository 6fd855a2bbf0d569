#include "core/denoise/tall_qr.hpp"

#include <cassert>
#include <cmath>

#include <Eigen/QR>

#include "core/signal/sums.hpp"

namespace gyrod::core {
TallQr::TallQr(std::size_t max_columns) : block_(max_columns * kBlockRows) {
  assert(max_columns <= kMaxRegressionColumns);
}

void TallQr::start(std::size_t columns) noexcept {
  assert(columns * kBlockRows <= block_.size());
  factor_.setZero(static_cast<Eigen::Index>(columns), static_cast<Eigen::Index>(columns));
}

std::span<double> TallQr::column(std::size_t index) noexcept {
  return std::span(block_).subspan(index * kBlockRows, kBlockRows);
}

void TallQr::absorb(std::size_t n) noexcept {
  assert(n <= kBlockRows);
  const Eigen::Index columns = factor_.cols();
  const auto block = [&](Eigen::Index index) { return column(static_cast<std::size_t>(index)).first(n); };
  for (Eigen::Index pivot = 0; pivot < columns; ++pivot) {
    // Below its diagonal the old R is zero, so a reflection concerns one row of R and the block.
    const std::span<const double> v = block(pivot);
    const double diagonal = factor_(pivot, pivot);
    const double below = dot(v, v);
    if (!(below > 0.0)) continue;
    const double norm = std::sqrt(diagonal * diagonal + below);
    const double reflected = diagonal > 0.0 ? -norm : norm;
    const double head = diagonal - reflected;
    const double half_square = -reflected * head;
    for (Eigen::Index other = pivot + 1; other < columns; ++other) {
      const std::span<double> target = block(other);
      const double factor = (head * factor_(pivot, other) + dot(v, target)) / half_square;
      factor_(pivot, other) -= factor * head;
      for (std::size_t row = 0; row < n; ++row) target[row] -= factor * v[row];
    }
    factor_(pivot, pivot) = reflected;
  }
}

LeastSquares least_squares(const RegressionMatrix& factor, std::span<const std::size_t> columns) noexcept {
  const auto count = static_cast<Eigen::Index>(columns.size());
  const Eigen::Index rows = factor.rows();
  assert(count < rows);
  LeastSquares result;
  const RegressionVector y = factor.col(rows - 1);
  result.coefficients.setZero(count);
  result.unit_errors.setZero(count);
  result.residual_sum = y.squaredNorm();
  result.regular = count == 0;
  if (count == 0) return result;

  RegressionMatrix x(rows, count);
  for (Eigen::Index i = 0; i < count; ++i)
    x.col(i) = factor.col(static_cast<Eigen::Index>(columns[static_cast<std::size_t>(i)]));
  // Columns of very different size (a series and its innovations) are compared each with itself.
  RegressionVector scale = x.colwise().norm();
  if (!(scale.minCoeff() > 0.0)) return result;
  x = (x * scale.cwiseInverse().asDiagonal()).eval();
  const Eigen::HouseholderQR<RegressionMatrix> qr(x);
  RegressionMatrix r = RegressionMatrix::Zero(count, count);
  r = qr.matrixQR().topRows(count);
  // A series of 10^6 rows is factorised to about 1e-13 of itself.
  constexpr double kNegligible = 1e-12;
  if (!(r.diagonal().cwiseAbs().minCoeff() > kNegligible)) return result;
  RegressionVector rotated = y;
  rotated.applyOnTheLeft(qr.householderQ().adjoint());
  const auto upper = r.triangularView<Eigen::Upper>();
  result.coefficients = upper.solve(RegressionVector(rotated.head(count))).cwiseQuotient(scale);
  const RegressionMatrix inverse = upper.solve(RegressionMatrix(RegressionMatrix::Identity(count, count)));
  result.unit_errors = RegressionVector(inverse.rowwise().norm()).cwiseQuotient(scale);
  result.residual_sum = rotated.tail(rows - count).squaredNorm();
  result.regular = result.coefficients.allFinite() && result.unit_errors.allFinite();
  return result;
}

}  // namespace gyrod::core
