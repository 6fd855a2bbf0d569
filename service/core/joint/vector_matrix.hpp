// The kernels of small matrices for the instruction set that the including file is compiled for; see core/emd/vector_lanes.hpp. No
// include guard: each file includes it once.
namespace gyrod::core::GYROD_KERNEL {

inline Lanes all(double value) noexcept { return value - Lanes{}; }

/// kRows x (kVectors registers) of the product, which stay in registers: kRows * kVectors chains of additions hide their latency.
template <std::size_t kRows, std::size_t kVectors>
inline void multiply_tile(std::size_t size, const double* a, std::size_t row_step, std::size_t inner_step,
                          const double* b, double* c) noexcept {
  Lanes sum[kRows][kVectors]{};
  for (std::size_t k = 0; k < size; ++k) {
    Lanes right[kVectors];
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kVectors; ++v) right[v] = load(b + k * kMatrixStride + v * kLanes);
#pragma GCC unroll 8
    for (std::size_t r = 0; r < kRows; ++r) {
      const Lanes left = all(a[r * row_step + k * inner_step]);
#pragma GCC unroll 4
      for (std::size_t v = 0; v < kVectors; ++v) sum[r][v] += left * right[v];
    }
  }
#pragma GCC unroll 8
  for (std::size_t r = 0; r < kRows; ++r) {
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kVectors; ++v) store(c + r * kMatrixStride + v * kLanes, sum[r][v]);
  }
}

inline void multiply(std::size_t size, const double* a, std::size_t row_step, std::size_t inner_step,
                     const double* b, double* c) noexcept {
  constexpr std::size_t kRows = 4;
  for (std::size_t i = 0; i < size; i += kRows) {
    std::size_t j = 0;
    for (; j + kLanes < size; j += 2 * kLanes) {
      multiply_tile<kRows, 2>(size, a + i * row_step, row_step, inner_step, b + j, c + i * kMatrixStride + j);
    }
    if (j < size) {
      multiply_tile<kRows, 1>(size, a + i * row_step, row_step, inner_step, b + j, c + i * kMatrixStride + j);
    }
  }
}

template <std::size_t kVectors>
inline void subtract_strip(const double* factors, std::size_t begin, std::size_t end, const double* other,
                           double* matrix) noexcept {
  Lanes part[kVectors];
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kVectors; ++v) part[v] = load(other + v * kLanes);
  for (std::size_t i = begin; i < end; ++i) {
    const Lanes factor = all(factors[i]);
    double* const row = matrix + i * kMatrixStride;
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kVectors; ++v)
      store(row + v * kLanes, load(row + v * kLanes) - factor * part[v]);
  }
}

inline void subtract(std::size_t padded, const double* factors, std::size_t begin, std::size_t end,
                     const double* other, double* matrix) noexcept {
  std::size_t j = 0;
  for (; j + 4 * kLanes <= padded; j += 4 * kLanes)
    subtract_strip<4>(factors, begin, end, other + j, matrix + j);
  for (; j < padded; j += kLanes) subtract_strip<1>(factors, begin, end, other + j, matrix + j);
}

template <std::size_t kVectors>
inline void subtract_tile(const double* factors, std::size_t begin, std::size_t end, const double* matrix,
                          double* row) noexcept {
  Lanes rest[kVectors];
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kVectors; ++v) rest[v] = load(row + v * kLanes);
  for (std::size_t k = begin; k < end; ++k) {
    const Lanes factor = all(factors[k]);
#pragma GCC unroll 4
    for (std::size_t v = 0; v < kVectors; ++v)
      rest[v] -= factor * load(matrix + k * kMatrixStride + v * kLanes);
  }
#pragma GCC unroll 4
  for (std::size_t v = 0; v < kVectors; ++v) store(row + v * kLanes, rest[v]);
}

inline void subtract_rows(std::size_t padded, const double* factors, std::size_t begin, std::size_t end,
                          const double* matrix, double* row) noexcept {
  std::size_t j = 0;
  for (; j + 4 * kLanes <= padded; j += 4 * kLanes)
    subtract_tile<4>(factors, begin, end, matrix + j, row + j);
  for (; j < padded; j += kLanes) subtract_tile<1>(factors, begin, end, matrix + j, row + j);
}

inline void advance_row(std::size_t padded, const CompanionRows& rows, const double* x,
                        double* out) noexcept {
  static_assert(kModeOrder == 3);
  for (std::size_t j = 0; j < padded; j += kLanes) {
    const Lanes moved = load(rows.shift.data() + j) * load(x + j - 1);
    const Lanes first = load(rows.head[0].data() + j) * load(x + j);
    const Lanes second = load(rows.head[1].data() + j) * load(x + j + 1);
    const Lanes third = load(rows.head[2].data() + j) * load(x + j + 2);
    store(out + j, moved + first + second + third);
  }
}

}  // namespace gyrod::core::GYROD_KERNEL
