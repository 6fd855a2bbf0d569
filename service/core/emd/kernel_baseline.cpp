/// The vector kernel for any processor: registers of two doubles (SSE2, NEON).
#include <bit>
#include <cstddef>
#include <cstdint>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "core/emd/boundary.hpp"
#include "core/emd/sift_kernel.hpp"

#define GYROD_KERNEL baseline
#define GYROD_LANES 2
// clang-format off
#include "core/emd/vector_lanes.hpp"
#include "core/emd/vector_extrema.hpp"
#include "core/emd/vector_spline.hpp"
#include "core/emd/vector_sift.hpp"
// clang-format on

namespace gyrod::core {

const SiftKernel kBaselineKernel{baseline::find_extrema, baseline::sift};

}  // namespace gyrod::core
