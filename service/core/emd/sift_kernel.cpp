#include "core/emd/sift_kernel.hpp"

#include <cassert>

namespace gyrod::core {
namespace {

EmdKernel fastest() noexcept {
  if (is_available(EmdKernel::kAvx512)) {
    return EmdKernel::kAvx512;
  }
  return is_available(EmdKernel::kAvx2) ? EmdKernel::kAvx2 : EmdKernel::kBaseline;
}

}  // namespace

bool is_available([[maybe_unused]] EmdKernel kernel) noexcept {
#ifdef __x86_64__
  if (kernel == EmdKernel::kAvx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("bmi") != 0;
  }
  if (kernel == EmdKernel::kAvx2) {
    return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0;
  }
#endif
  return kernel != EmdKernel::kAvx2 && kernel != EmdKernel::kAvx512;
}

const SiftKernel& sift_kernel(EmdKernel kernel) noexcept {
  assert(is_available(kernel));
  switch (kernel == EmdKernel::kFastest ? fastest() : kernel) {
    case EmdKernel::kReference:
      return kReferenceKernel;
#ifdef __x86_64__
    case EmdKernel::kAvx2:
      return kAvx2Kernel;
    case EmdKernel::kAvx512:
      return kAvx512Kernel;
#endif
    default:
      return kBaselineKernel;
  }
}

}  // namespace gyrod::core
