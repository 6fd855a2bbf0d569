/// The kernels of the slow loop for AVX-512: registers of eight doubles. Only what stands between push and pop is
/// compiled for it, as in core/emd.
#include <cstddef>
#include <cstdint>

#include "core/joint/matrix_kernel.hpp"
#include "core/joint/spectral_kernel.hpp"

#ifdef __x86_64__
#include <immintrin.h>

#define GYROD_KERNEL avx512
#define GYROD_LANES 8
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512vl,bmi,popcnt"))), \
                             apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,bmi,popcnt")
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

const MatrixKernel kAvx512Matrix{avx512::multiply, avx512::subtract, avx512::subtract_rows,
                                 avx512::advance_row};
const SpectralKernel kAvx512Spectral{avx512::add_spectrum, avx512::autocovariances};

}  // namespace gyrod::core
#endif
