/// The kernels of the slow loop for any processor: registers of two doubles (SSE2, NEON).
#include <cstddef>
#include <cstdint>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "core/joint/matrix_kernel.hpp"
#include "core/joint/spectral_kernel.hpp"

#define GYROD_KERNEL baseline
#define GYROD_LANES 2
// clang-format off
#include "core/emd/vector_lanes.hpp"
#include "core/joint/vector_matrix.hpp"
#include "core/joint/vector_spectral.hpp"
// clang-format on

namespace gyrod::core {

const MatrixKernel kBaselineMatrix{baseline::multiply, baseline::subtract, baseline::subtract_rows,
                                   baseline::advance_row};
const SpectralKernel kBaselineSpectral{baseline::add_spectrum, baseline::autocovariances};

}  // namespace gyrod::core
