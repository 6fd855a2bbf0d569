#include "core/joint/spectral_kernel.hpp"

#include <cassert>

namespace gyrod::core {

const SpectralKernel& spectral_kernel(EmdKernel kernel) noexcept {
  assert(is_available(kernel));
#ifdef __x86_64__
  const bool any = kernel == EmdKernel::kFastest;
  if (kernel == EmdKernel::kAvx512 || (any && is_available(EmdKernel::kAvx512))) return kAvx512Spectral;
  if (kernel == EmdKernel::kAvx2 || (any && is_available(EmdKernel::kAvx2))) return kAvx2Spectral;
#endif
  return kBaselineSpectral;
}

}  // namespace gyrod::core
