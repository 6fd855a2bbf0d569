// R of a factorisation in blocks, and regression by it, against the normal equations.
#include "core/denoise/tall_qr.hpp"

#include <array>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::LeastSquares;
using core::TallQr;
using namespace testing;

/// Columns of white noise, put in in blocks of this many rows.
TallQr factorised(const std::vector<Signal>& columns, std::size_t block) {
  TallQr qr(columns.size());
  qr.start(columns.size());
  for (std::size_t row = 0; row < columns[0].size(); row += block) {
    const std::size_t count = std::min(block, columns[0].size() - row);
    for (std::size_t i = 0; i < columns.size(); ++i)
      std::ranges::copy(std::span(columns[i]).subspan(row, count), qr.column(i).begin());
    qr.absorb(count);
  }
  return qr;
}

std::vector<Signal> noise_columns(std::size_t count, std::size_t rows) {
  std::vector<Signal> columns;
  for (unsigned i = 0; i < count; ++i) columns.push_back(white_noise(rows, i + 1));
  return columns;
}

// R'R = [X | y]'[X | y].
TEST(TallQr, FactorSquaredIsTheGramMatrixWhateverTheBlocks) {
  const auto columns = noise_columns(5, 1000);
  for (const std::size_t block : {1U, 7U, 512U}) {
    const TallQr qr = factorised(columns, block);
    const auto& r = qr.factor();
    for (std::size_t i = 0; i < 5; ++i) {
      for (std::size_t j = 0; j < 5; ++j) {
        double product = 0.0;
        for (std::size_t n = 0; n < 1000; ++n) product += columns[i][n] * columns[j][n];
        const auto column_i = r.col(static_cast<Eigen::Index>(i));
        const auto column_j = r.col(static_cast<Eigen::Index>(j));
        EXPECT_NEAR(column_i.dot(column_j), product, 1e-10);
      }
    }
  }
}

// One column: c = x'y / x'x, error 1 / sqrt(x'x), residual y'y - c x'y.
TEST(LeastSquares, OfOneColumnIsTheClosedForm) {
  auto columns = noise_columns(3, 2000);
  columns[2] = sum(columns[2], columns[1], 3.0);
  const LeastSquares fit =
      core::least_squares(factorised(columns, 512).factor(), std::array<std::size_t, 1>{1});
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t n = 0; n < 2000; ++n) {
    xx += columns[1][n] * columns[1][n];
    xy += columns[1][n] * columns[2][n];
    yy += columns[2][n] * columns[2][n];
  }
  ASSERT_TRUE(fit.regular);
  EXPECT_NEAR(fit.coefficients(0), xy / xx, 1e-12);
  EXPECT_NEAR(fit.unit_errors(0), 1.0 / std::sqrt(xx), 1e-14);
  EXPECT_NEAR(fit.residual_sum, yy - xy * xy / xx, 1e-9);
}

TEST(LeastSquares, FindsAnExactCombinationAndLeavesNothing) {
  auto columns = noise_columns(4, 3000);
  columns[3] = sum(times(columns[0], 2.0), columns[2], -5.0);
  const LeastSquares fit =
      core::least_squares(factorised(columns, 512).factor(), std::array<std::size_t, 3>{0, 1, 2});
  ASSERT_TRUE(fit.regular);
  EXPECT_NEAR(fit.coefficients(0), 2.0, 1e-13);
  EXPECT_NEAR(fit.coefficients(1), 0.0, 1e-13);
  EXPECT_NEAR(fit.coefficients(2), -5.0, 1e-13);
  EXPECT_LE(fit.residual_sum, 1e-24 * 3000.0);
}

TEST(LeastSquares, SaysThatColumnsAreDependent) {
  auto columns = noise_columns(4, 3000);
  columns[1] = times(columns[0], 3.0);
  const auto qr = factorised(columns, 512);
  EXPECT_FALSE(core::least_squares(qr.factor(), std::array<std::size_t, 2>{0, 1}).regular);
  EXPECT_TRUE(core::least_squares(qr.factor(), std::array<std::size_t, 2>{1, 2}).regular);
}

}  // namespace
}  // namespace gyrod
