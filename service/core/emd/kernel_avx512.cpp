/// The vector kernel for AVX-512: registers of eight doubles. Only what stands between push and pop is
/// compiled for it: the standard library's inline functions, which the linker shares between files, stay
/// runnable on every processor.
#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/emd/boundary.hpp"
#include "core/emd/sift_kernel.hpp"

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
#include "core/emd/vector_extrema.hpp"
#include "core/emd/vector_spline.hpp"
#include "core/emd/vector_sift.hpp"
// clang-format on
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace gyrod::core {

const SiftKernel kAvx512Kernel{avx512::find_extrema, avx512::sift};

}  // namespace gyrod::core
#endif
