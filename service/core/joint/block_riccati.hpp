/// The Riccati equation of a sum of autoregressive processes in white noise.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/matrix_kernel.hpp"
#include "core/joint/member_model.hpp"

namespace gyrod::core {

/// Solves for the covariance X of the state's prediction in the steady state,
///   X = A (X - X H (H' X H + r)^-1 H' X) A' + Q,
/// A, Q, H as in MemberModel. A few steps of the recursion itself from X = 0, which the companion blocks make cheap, carry along
/// what they do to any start: (a, G, X), with
///   K = X H / S,  G <- G + a H H' a' / S,  a' <- A (I - K H') a',  X <- A (X - K K' S) A' + Q,
/// and structured doubling goes on from there: W = I + G X,
///   a <- a W^-1 a,   G <- G + a W^-1 G a',   X <- X + (W^-1 a)' X a.
/// About 170 KB; allocates nothing; the same bits on every processor. Not thread-safe.
/// Source: Anderson, Moore 1979, chapter 4; Chu, Fan, Lin, Wang 2004 (doubling).
class BlockRiccati {
 public:
  explicit BlockRiccati(EmdKernel kernel = EmdKernel::kFastest) noexcept : kernel_(matrix_kernel(kernel)) {}

  /// @return false where it did not settle, or where the answer does not meet the equation
  /// @pre r > 0; the orders of the blocks are positive and add up to at most kMaxStates
  [[nodiscard]] bool solve(const BlockSet& blocks, double r) noexcept;

  /// X H, after solve().
  [[nodiscard]] std::span<const double> observed_covariance() const noexcept {
    return {observed_.data(), size_};
  }
  /// S = H' X H + r, after solve().
  [[nodiscard]] double innovation_variance() const noexcept { return innovation_variance_; }
  /// X(i, j), after solve().
  [[nodiscard]] double covariance(std::size_t i, std::size_t j) const noexcept {
    return X_[i * kMatrixStride + j];
  }

 private:
  static constexpr int kSteps = 16;

  void begin(const BlockSet& blocks, double r) noexcept;
  void add_block(const FilterBlock& block, std::size_t head) noexcept;
  void observe() noexcept;
  void add_heads(const MatrixBuffer& matrix, std::array<double, kMatrixStride>& sum) noexcept;
  void add(const MatrixBuffer& growth, MatrixBuffer& matrix) const noexcept;
  void step() noexcept;
  void move_rows(MatrixBuffer& matrix) noexcept;
  void move_columns() noexcept;
  [[nodiscard]] bool double_until_settled() noexcept;
  void double_transition() noexcept;
  [[nodiscard]] bool factorise() noexcept;
  void exchange(std::size_t i, std::size_t j) noexcept;
  void divide(const MatrixBuffer& right, MatrixBuffer& out) noexcept;
  [[nodiscard]] bool meets_equation() noexcept;
  void multiply(const MatrixBuffer& a, const MatrixBuffer& b, MatrixBuffer& c) const noexcept;
  void multiply_transposed(const MatrixBuffer& a, const MatrixBuffer& b, MatrixBuffer& c) const noexcept;

  const MatrixKernel& kernel_;
  const BlockSet* blocks_ = nullptr;  ///< of solve(), while it runs
  std::size_t size_ = 0;
  std::size_t padded_ = 0;
  double r_ = 1.0;
  double innovation_variance_ = 1.0;
  CompanionRows rows_;
  std::array<std::size_t, kMatrixStride> order_{};     ///< rows of the right-hand side, as exchanged
  std::array<double, kMatrixStride> inverse_pivot_{};  ///< 1 / U(i, i)
  alignas(64) RowBuffer row_{};
  alignas(64) std::array<double, kMatrixStride> observed_{};  ///< X H
  alignas(64) std::array<double, kMatrixStride> response_{};  ///< a H
  alignas(64) std::array<double, kMatrixStride> head_row_{};
  alignas(64) std::array<double, kMatrixStride> factors_{};
  alignas(64) MatrixBuffer transition_{};  ///< a, its transpose while single steps are made
  alignas(64) MatrixBuffer transposed_{};
  alignas(64) MatrixBuffer G_{};
  alignas(64) MatrixBuffer X_{};
  alignas(64) MatrixBuffer W_{};      ///< U, after factorise()
  alignas(64) MatrixBuffer lower_{};  ///< L
  alignas(64) MatrixBuffer divided_{};
  alignas(64) MatrixBuffer product_{};
  alignas(64) MatrixBuffer growth_{};
};

}  // namespace gyrod::core
