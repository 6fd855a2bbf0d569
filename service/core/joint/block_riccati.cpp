#include "core/joint/block_riccati.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kStride = kMatrixStride;

double* row_of(MatrixBuffer& matrix, std::size_t i) noexcept { return matrix.data() + i * kStride; }
const double* row_of(const MatrixBuffer& matrix, std::size_t i) noexcept {
  return matrix.data() + i * kStride;
}

/// Sum of squares; columns beyond `size` are zero.
double square_norm(const MatrixBuffer& matrix, std::size_t size) noexcept {
  return sum_of({matrix.data(), size * kStride}, [](auto value) { return value * value; });
}

/// The mean of both triangles for both: their difference is rounding, which would grow with every doubling.
void symmetrise(MatrixBuffer& matrix, std::size_t size) noexcept {
  for (std::size_t i = 1; i < size; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double mean = 0.5 * (matrix[i * kStride + j] + matrix[j * kStride + i]);
      matrix[i * kStride + j] = mean;
      matrix[j * kStride + i] = mean;
    }
  }
}

void transpose(const MatrixBuffer& matrix, std::size_t size, MatrixBuffer& out) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) out[j * kStride + i] = matrix[i * kStride + j];
  }
}

}  // namespace

bool BlockRiccati::solve(const BlockSet& blocks, double r) noexcept {
  begin(blocks, r);
  for (int k = 1; k < kSteps; ++k) step();
  symmetrise(X_, size_);
  symmetrise(G_, size_);
  transpose(transition_, size_, transposed_);
  std::swap(transition_, transposed_);
  return double_until_settled() && meets_equation();
}

/// (a, G, X) = (A', H H' / r, Q); a is kept as its transpose until the doubling begins.
void BlockRiccati::begin(const BlockSet& blocks, double r) noexcept {
  blocks_ = &blocks;
  r_ = r;
  size_ = 0;
  for (const FilterBlock& block : blocks.all()) size_ += block.order;
  assert(size_ > 0 && size_ <= kMaxStates && r > 0.0);
  padded_ = (size_ + kMatrixPadding - 1) / kMatrixPadding * kMatrixPadding;
  rows_ = {};
  for (MatrixBuffer* matrix :
       {&transition_, &transposed_, &G_, &X_, &W_, &lower_, &divided_, &product_, &growth_}) {
    std::fill_n(matrix->begin(), padded_ * kStride, 0.0);
  }
  row_.fill(0.0);
  std::size_t head = 0;
  for (const FilterBlock& block : blocks.all()) {
    add_block(block, head);
    std::size_t other = 0;
    for (const FilterBlock& column : blocks.all()) {
      G_[head * kStride + other] = 1.0 / r;
      other += column.order;
    }
    head += block.order;
  }
}

void BlockRiccati::add_block(const FilterBlock& block, std::size_t head) noexcept {
  X_[head * kStride + head] = block.drive;
  for (std::size_t i = 0; i < block.order; ++i) {
    transition_[head * kStride + head + i] = block.a[i];
    if (block.order <= kModeOrder) rows_.head[i][head] = block.a[i];
  }
  for (std::size_t i = 1; i < block.order; ++i) {
    transition_[(head + i) * kStride + head + i - 1] = 1.0;
    rows_.shift[head + i] = 1.0;
  }
}

/// The sum of the heads' rows: H' matrix.
void BlockRiccati::add_heads(const MatrixBuffer& matrix, std::array<double, kMatrixStride>& sum) noexcept {
  sum.fill(0.0);
  factors_.fill(0.0);
  std::size_t head = 0;
  for (const FilterBlock& block : blocks_->all()) {
    factors_[head] = -1.0;
    kernel_.subtract_rows(padded_, factors_.data(), head, head + 1, matrix.data(), sum.data());
    head += block.order;
  }
}

/// X H and S of the X at hand; X is symmetric.
void BlockRiccati::observe() noexcept {
  add_heads(X_, observed_);
  innovation_variance_ = r_;
  std::size_t head = 0;
  for (const FilterBlock& block : blocks_->all()) {
    innovation_variance_ += observed_[head];
    head += block.order;
  }
}

/// One step of the recursion.
void BlockRiccati::step() noexcept {
  observe();
  add_heads(transition_, response_);
  const double inverse = 1.0 / innovation_variance_;
  for (std::size_t i = 0; i < size_; ++i) factors_[i] = -response_[i] * inverse;
  kernel_.subtract(padded_, factors_.data(), 0, size_, response_.data(), G_.data());
  for (std::size_t i = 0; i < size_; ++i) factors_[i] = observed_[i] * inverse;
  kernel_.subtract(padded_, factors_.data(), 0, size_, response_.data(), transition_.data());
  kernel_.subtract(padded_, factors_.data(), 0, size_, observed_.data(), X_.data());
  move_rows(transition_);
  move_rows(X_);
  move_columns();
}

/// matrix <- A matrix.
void BlockRiccati::move_rows(MatrixBuffer& matrix) noexcept {
  std::size_t head = 0;
  for (const FilterBlock& block : blocks_->all()) {
    head_row_.fill(0.0);
    for (std::size_t i = 0; i < block.order; ++i) factors_[i] = -block.a[i];
    double* const first = row_of(matrix, head);
    kernel_.subtract_rows(padded_, factors_.data(), 0, block.order, first, head_row_.data());
    std::copy_backward(first, first + (block.order - 1) * kStride, first + block.order * kStride);
    std::copy_n(head_row_.data(), padded_, first);
    head += block.order;
  }
}

/// X <- X A' + Q.
void BlockRiccati::move_columns() noexcept {
  double* const x = row_.data() + kMatrixPadding;
  for (std::size_t i = 0; i < size_; ++i) {
    double* const row = row_of(X_, i);
    std::copy_n(row, padded_, x);
    kernel_.advance_row(padded_, rows_, x, row);
    std::size_t head = 0;
    for (const FilterBlock& block : blocks_->all()) {
      if (block.order > kModeOrder) {
        row[head] = 0.0;
        for (std::size_t l = 0; l < block.order; ++l) row[head] += block.a[l] * x[head + l];
      }
      if (i == head) row[head] += block.drive;
      head += block.order;
    }
  }
}

bool BlockRiccati::double_until_settled() noexcept {
  // 2^34 steps. Growth falls quadratically: after one of kSettled the next would be below rounding.
  constexpr int kMaxDoublings = 30;
  constexpr double kSettled = 1e-8;
  for (int k = 0; k < kMaxDoublings; ++k) {
    multiply(G_, X_, W_);
    for (std::size_t i = 0; i < size_; ++i) W_[i * kStride + i] += 1.0;
    if (!factorise()) return false;
    divide(transition_, divided_);
    multiply(X_, transition_, product_);
    multiply_transposed(divided_, product_, growth_);
    add(growth_, X_);
    symmetrise(X_, size_);
    const double norm = square_norm(X_, size_);
    const double growth = square_norm(growth_, size_);
    if (!std::isfinite(norm)) return false;
    if (growth <= kSettled * kSettled * norm) return true;
    double_transition();
  }
  return false;
}

/// a and G, from W^-1 a in divided_ and W's factors.
void BlockRiccati::double_transition() noexcept {
  multiply(transition_, divided_, growth_);  // a W^-1 a
  divide(G_, divided_);
  transpose(transition_, size_, transposed_);
  multiply(divided_, transposed_, product_);
  multiply(transition_, product_, divided_);
  add(divided_, G_);
  symmetrise(G_, size_);
  std::copy_n(growth_.begin(), padded_ * kStride, transition_.begin());
}

/// W = P L U by rows, the largest element of the column leading.
bool BlockRiccati::factorise() noexcept {
  for (std::size_t i = 0; i < size_; ++i) order_[i] = i;
  for (std::size_t k = 0; k < size_; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < size_; ++i) {
      if (std::abs(W_[i * kStride + k]) > std::abs(W_[pivot * kStride + k])) pivot = i;
    }
    if (pivot != k) exchange(k, pivot);
    const double inverse = 1.0 / W_[k * kStride + k];
    if (!std::isfinite(inverse)) return false;
    inverse_pivot_[k] = inverse;
    for (std::size_t i = k + 1; i < size_; ++i) {
      factors_[i] = W_[i * kStride + k] * inverse;
      lower_[i * kStride + k] = factors_[i];
    }
    const std::size_t begin = (k + 1) / kMatrixPadding * kMatrixPadding;
    kernel_.subtract(padded_ - begin, factors_.data(), k + 1, size_, row_of(W_, k) + begin,
                     W_.data() + begin);
  }
  return true;
}

void BlockRiccati::exchange(std::size_t i, std::size_t j) noexcept {
  std::swap_ranges(row_of(W_, i), row_of(W_, i) + padded_, row_of(W_, j));
  std::swap_ranges(row_of(lower_, i), row_of(lower_, i) + padded_, row_of(lower_, j));
  std::swap(order_[i], order_[j]);
}

/// out = W^-1 right.
void BlockRiccati::divide(const MatrixBuffer& right, MatrixBuffer& out) noexcept {
  for (std::size_t i = 0; i < size_; ++i) {
    std::copy_n(row_of(right, order_[i]), padded_, row_of(out, i));
    kernel_.subtract_rows(padded_, row_of(lower_, i), 0, i, out.data(), row_of(out, i));
  }
  for (std::size_t i = size_; i-- > 0;) {
    double* const row = row_of(out, i);
    kernel_.subtract_rows(padded_, row_of(W_, i), i + 1, size_, out.data(), row);
    for (std::size_t j = 0; j < padded_; ++j) row[j] *= inverse_pivot_[i];
  }
}

/// One more step of the recursion leaves X H where it is, but for a thousandth: gains that are that much off cost a millionth of the error. Smooth
/// motion far above the noise has modes with all their roots next to 1, of which rounding leaves a part in 1e5.
bool BlockRiccati::meets_equation() noexcept {
  constexpr double kTolerance = 1e-3;
  std::copy_n(X_.begin(), padded_ * kStride, growth_.begin());
  step();
  observe();
  std::swap(observed_, response_);
  std::copy_n(growth_.begin(), padded_ * kStride, X_.begin());
  observe();
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < size_; ++i) {
    difference = std::max(difference, std::abs(observed_[i] - response_[i]));
    size = std::max(size, std::abs(observed_[i]));
  }
  return innovation_variance_ > 0.0 && std::isfinite(innovation_variance_) && difference <= kTolerance * size;
}

void BlockRiccati::add(const MatrixBuffer& growth, MatrixBuffer& matrix) const noexcept {
  for (std::size_t i = 0; i < size_; ++i) {
    const double* const from = row_of(growth, i);
    double* const to = row_of(matrix, i);
    for (std::size_t j = 0; j < padded_; ++j) to[j] += from[j];
  }
}

void BlockRiccati::multiply(const MatrixBuffer& a, const MatrixBuffer& b, MatrixBuffer& c) const noexcept {
  kernel_.multiply(size_, a.data(), kStride, 1, b.data(), c.data());
}

/// c = a' b.
void BlockRiccati::multiply_transposed(const MatrixBuffer& a, const MatrixBuffer& b,
                                       MatrixBuffer& c) const noexcept {
  kernel_.multiply(size_, a.data(), 1, kStride, b.data(), c.data());
}

}  // namespace gyrod::core
