/// One sift, in several implementations that are chosen at run time.
#pragma once

#include "core/emd/sift_workspace.hpp"

namespace gyrod::core {

/// An implementation of sifting. The vector kernels do the same arithmetic for every element and give the
/// same bits; the reference kernel is the plain one that decides what is right, and the others differ from it
/// by rounding. Neither function allocates; both may be called from any thread, each with its own workspace.
struct SiftKernel {
  /// Finds the extrema of ws.signal.
  void (*find_extrema)(SiftWorkspace& ws) noexcept;

  /// Subtracts the mean of the envelopes from ws.signal, and finds the extrema of what remains:
  ///   h <- h - (upper + lower) / 2,   [Huang1998] section 5.
  /// The envelopes are natural cubic splines through the maxima and through the minima.
  /// @pre ws.extrema are those of ws.signal, and at least 3
  void (*sift)(SiftWorkspace& ws) noexcept;
};

/// The kernel asked for; kFastest is the widest one that this processor runs.
/// @pre is_available(kernel)
const SiftKernel& sift_kernel(EmdKernel kernel) noexcept;

extern const SiftKernel kReferenceKernel;
extern const SiftKernel kBaselineKernel;
#ifdef __x86_64__
extern const SiftKernel kAvx2Kernel;
extern const SiftKernel kAvx512Kernel;
#endif

}  // namespace gyrod::core
