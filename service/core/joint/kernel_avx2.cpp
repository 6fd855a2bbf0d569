/// The kernels of the slow loop for AVX2: registers of four doubles. Only what stands between push and pop is
/// compiled for it, as in core/emd.
#include <cstddef>
#include <cstdint>

#include "core/joint/matrix_kernel.hpp"
#include "core/joint/spectral_kernel.hpp"

#ifdef __x86_64__
#include <immintrin.h>

#define GYROD_KERNEL avx2
#define GYROD_LANES 4
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,bmi,popcnt"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,bmi,popcnt")
#endif
// clang-format off
#include "core/emd/vector_lanes.hpp"
#include "core/joint/vector_matrix.hpp"
#include "core/joint/vector_spectral.hpp"
// clang-format on
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace gyrod::core {

const MatrixKernel kAvx2Matrix{avx2::multiply, avx2::subtract, avx2::subtract_rows, avx2::advance_row};
const SpectralKernel kAvx2Spectral{avx2::add_spectrum, avx2::autocovariances};

}  // namespace gyrod::core
#endif
