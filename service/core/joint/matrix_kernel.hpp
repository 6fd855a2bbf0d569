/// The arithmetic of the slow loop's small matrices, in several implementations that are chosen at run time.
#pragma once

#include <array>
#include <cstddef>

#include "core/emd/emd.hpp"
#include "core/joint/member_model.hpp"

namespace gyrod::core {

/// Rows of matrices are this long in memory; sizes are padded to multiples of kMatrixPadding with zeros.
inline constexpr std::size_t kMatrixPadding = 8;
inline constexpr std::size_t kMatrixStride =
    (kMaxStates + kMatrixPadding - 1) / kMatrixPadding * kMatrixPadding;

/// A square matrix by rows; at (i, j) stands i * kMatrixStride + j.
using MatrixBuffer = std::array<double, kMatrixStride * kMatrixStride>;
/// A vector with room before and behind it, so that its neighbours can be read everywhere.
using RowBuffer = std::array<double, kMatrixStride + 2 * kMatrixPadding>;

/// The transition A of companion blocks, as what makes x' A' of a row x:
///   (x A')_c = shift_c x_(c-1) + head_c,0 x_c + head_c,1 x_(c+1) + head_c,2 x_(c+2),   and the heads of longer blocks by themselves.
struct CompanionRows {
  std::array<double, kMatrixStride> shift{};
  std::array<std::array<double, kMatrixStride>, kModeOrder> head{};
};

/// All kernels do the same arithmetic for every element, in the same order, and give the same bits. None allocates; `padded`, the
/// length of the rows, is a multiple of kMatrixPadding, and every pointer is to a row of kMatrixStride.
struct MatrixKernel {
  /// c = a b of `size` rows, rounded up to four, with a(i, k) at a[i * row_step + k * inner_step]: (kMatrixStride, 1) is a itself,
  /// (1, kMatrixStride) its transpose. @pre rows and columns from `size` on are zero
  void (*multiply)(std::size_t size, const double* a, std::size_t row_step, std::size_t inner_step,
                   const double* b, double* c) noexcept;
  /// row_i <- row_i - factors[i] * other for the rows begin..end of the matrix.
  void (*subtract)(std::size_t padded, const double* factors, std::size_t begin, std::size_t end,
                   const double* other, double* matrix) noexcept;
  /// row <- row - sum_(begin <= k < end) factors[k] row_k of the matrix.
  void (*subtract_rows)(std::size_t padded, const double* factors, std::size_t begin, std::size_t end,
                        const double* matrix, double* row) noexcept;
  /// out = x A' but for the heads of longer blocks. @pre x lies in a RowBuffer, kMatrixPadding behind its begin
  void (*advance_row)(std::size_t padded, const CompanionRows& rows, const double* x, double* out) noexcept;
};

/// The kernel asked for; kFastest is the widest one that this processor runs. kReference is the same as kBaseline here.
/// @pre is_available(kernel)
[[nodiscard]] const MatrixKernel& matrix_kernel(EmdKernel kernel = EmdKernel::kFastest) noexcept;

extern const MatrixKernel kBaselineMatrix;
#ifdef __x86_64__
extern const MatrixKernel kAvx2Matrix;
extern const MatrixKernel kAvx512Matrix;
#endif

}  // namespace gyrod::core
