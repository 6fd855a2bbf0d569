/// Empirical mode decomposition (EMD) with cubic-spline envelopes and a fixed number of sifts.
///
///   y(t) = sum_{i=1..n} IMF_i(t) + r(t),   IMF_1 the fastest.   [Yang2019] eq. (1), [Huang1998].
///
/// A fixed sift count makes the time bounded and the result a plain function of the input: same input, same
/// bits.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace gyrod::core {

/// How the envelopes continue beyond the first and last extremum.
enum class BoundaryRule {
  kMirror,  ///< extrema mirrored at the ends [Rilling2003]
  kLinear,  ///< the two end extrema of a kind extrapolated linearly to the ends [Wu2009]
};

/// Which implementation of sifting runs. The vector kernels (baseline, AVX2, AVX-512) give the same bits on
/// every processor; the reference differs from them by rounding.
enum class EmdKernel {
  kFastest,    ///< the widest vector kernel that this processor runs
  kReference,  ///< plain loops and the Thomas algorithm: decides what is right
  kBaseline,   ///< vectors of two, on any processor
  kAvx2,
  kAvx512,
};

/// Whether this build and this processor run a kernel.
[[nodiscard]] bool is_available(EmdKernel kernel) noexcept;

struct EmdOptions {
  /// Sifts per IMF. Unit: count, range 1..100. Source: the noise line (core/denoise/noise_line.hpp) holds for 10.
  int sifts = 10;
  /// IMFs at the most. Unit: count, range 1..32.
  int max_imfs = 24;
  /// Extrema that a remainder needs to hold another IMF. Unit: count, range 3..16.
  int min_extrema = 3;
  /// A remainder whose peak-to-peak amplitude is below this part of the input's is residue: what is left is
  /// rounding noise. Relative, never absolute, so that rad/s and deg/s give the same modes. Range 0..1.
  double min_relative_amplitude = 1e-12;
  BoundaryRule boundary = BoundaryRule::kMirror;
};

/// Decomposes one signal at a time, mode by mode. Sizes its workspace once; no call allocates after that.
/// One object per worker; not thread-safe, objects are independent.
///
///     Emd emd(1024);
///     emd.start(window);
///     while (emd.next_imf(imf)) use(imf);   // stop early at will: residue() is what has not been taken out
///     use(emd.residue());
class Emd {
 public:
  /// @param max_samples longest signal that start() will be given, at least 1
  /// @param kernel for tests and benchmarks; leave it out elsewhere
  /// @throws std::invalid_argument for an option outside its range, naming it
  /// @pre is_available(kernel)
  explicit Emd(std::size_t max_samples, EmdOptions options = {}, EmdKernel kernel = EmdKernel::kFastest);
  ~Emd();
  Emd(Emd&&) noexcept;
  Emd& operator=(Emd&&) noexcept;

  /// Begins with a new signal (copied), uniformly sampled, any unit.
  /// @pre 1 <= signal.size() <= max_samples and every value finite
  void start(std::span<const double> signal) noexcept;

  /// Takes the next IMF out of the remainder and writes it to `imf`.
  /// @pre imf.size() == the signal's size
  /// @return false, with `imf` untouched, when the remainder is the residue: fewer than min_extrema extrema,
  /// below min_relative_amplitude, max_imfs reached, or an IMF that would not be finite or would exceed 2^20
  /// times the input (a guard: envelopes through a few extrema far apart can overshoot)
  [[nodiscard]] bool next_imf(std::span<double> imf) noexcept;

  /// What has not been taken out yet; after next_imf() returned false, the residue r(t).
  /// Valid until the next call.
  [[nodiscard]] std::span<const double> residue() const noexcept;

  [[nodiscard]] const EmdOptions& options() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::core
