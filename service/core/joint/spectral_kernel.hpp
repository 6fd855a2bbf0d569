/// The arithmetic of the Whittle fit over frequencies, in several implementations that are chosen at run time.
#pragma once

#include <cstddef>

#include "core/emd/emd.hpp"
#include "core/joint/spectral_mode.hpp"

namespace gyrod::core {

/// Autocovariances that a mode is made of.
inline constexpr std::size_t kModeLags = kModeOrder + 1;

/// All kernels do the same arithmetic for every frequency, sum in the same order, and give the same bits. None allocates.
struct SpectralKernel {
  /// out = drive / |a|^2 and sum += out at `bins` frequencies, whose cos(l w) and sin(l w) stand in row l = 0..kModeOrder of the tables.
  void (*add_spectrum)(std::size_t bins, const SpectralMode& mode, const double* cosines, const double* sines,
                       double* out, double* sum) noexcept;
  /// r_l = sum_k weights_l,k (S_k + S_k^2 deviation_k), l = 0..kModeOrder: the autocovariances of the posterior spectrum.
  void (*autocovariances)(std::size_t bins, const double* spectrum, const double* deviation,
                          const double* weights, double* r) noexcept;
};

/// As matrix_kernel(). @pre is_available(kernel)
[[nodiscard]] const SpectralKernel& spectral_kernel(EmdKernel kernel = EmdKernel::kFastest) noexcept;

extern const SpectralKernel kBaselineSpectral;
#ifdef __x86_64__
extern const SpectralKernel kAvx2Spectral;
extern const SpectralKernel kAvx512Spectral;
#endif

}  // namespace gyrod::core
