// The kernels of the Whittle fit for the instruction set that the including file is compiled for; see core/emd/vector_lanes.hpp. No
// include guard: each file includes it once.
namespace gyrod::core::GYROD_KERNEL {

static_assert(kModeOrder == 3, "written out for three coefficients");

/// Smallest |a|^2 that a spectrum is divided by: a pole 1e-12 from the unit circle, far below what the fit can tell.
constexpr double kLeastResponse = 1e-24;

/// drive / |a|^2, from real and imaginary part: near zero frequency the coefficients of |a|^2 itself would cancel.
template <class Value>
inline Value mode_spectrum(const SpectralMode& mode, const Value* cosine, const Value* sine) noexcept {
  const Value real = 1.0 - mode.a[0] * cosine[0] - mode.a[1] * cosine[1] - mode.a[2] * cosine[2];
  const Value imaginary = mode.a[0] * sine[0] + mode.a[1] * sine[1] + mode.a[2] * sine[2];
  return mode.drive / (real * real + imaginary * imaginary + kLeastResponse);
}

inline void add_spectrum(std::size_t bins, const SpectralMode& mode, const double* cosines,
                         const double* sines, double* out, double* sum) noexcept {
  std::size_t k = 0;
  for (; k + kLanes <= bins; k += kLanes) {
    const double* const c = cosines + k;
    const double* const s = sines + k;
    const Lanes cosine[] = {load(c + bins), load(c + 2 * bins), load(c + 3 * bins)};
    const Lanes sine[] = {load(s + bins), load(s + 2 * bins), load(s + 3 * bins)};
    const Lanes spectrum = mode_spectrum(mode, cosine, sine);
    store(out + k, spectrum);
    store(sum + k, load(sum + k) + spectrum);
  }
  for (; k < bins; ++k) {
    const double cosine[] = {cosines[bins + k], cosines[2 * bins + k], cosines[3 * bins + k]};
    const double sine[] = {sines[bins + k], sines[2 * bins + k], sines[3 * bins + k]};
    out[k] = mode_spectrum(mode, cosine, sine);
    sum[k] += out[k];
  }
}

/// Eight partial sums a lag, whatever the registers hold: the order of additions of core/signal/sums.hpp.
inline void autocovariances(std::size_t bins, const double* spectrum, const double* deviation,
                            const double* weights, double* r) noexcept {
  constexpr std::size_t kSums = 8;
  constexpr std::size_t kRegisters = kSums / kLanes;
  Lanes sums[kModeLags][kRegisters]{};
  std::size_t k = 0;
  for (; k + kSums <= bins; k += kSums) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kRegisters; ++i) {
      const std::size_t at = k + i * kLanes;
      const Lanes S = load(spectrum + at);
      const Lanes posterior = S + S * S * load(deviation + at);
#pragma GCC unroll 4
      for (std::size_t lag = 0; lag < kModeLags; ++lag)
        sums[lag][i] += posterior * load(weights + lag * bins + at);
    }
  }
  double rest[kModeLags]{};
  for (; k < bins; ++k) {
    const double posterior = spectrum[k] + spectrum[k] * spectrum[k] * deviation[k];
    for (std::size_t lag = 0; lag < kModeLags; ++lag) rest[lag] += posterior * weights[lag * bins + k];
  }
  for (std::size_t lag = 0; lag < kModeLags; ++lag) {
    double part[kSums];
    for (std::size_t i = 0; i < kRegisters; ++i) store(part + i * kLanes, sums[lag][i]);
    const double even = (part[0] + part[2]) + (part[4] + part[6]);
    const double odd = (part[1] + part[3]) + (part[5] + part[7]);
    r[lag] = (even + odd) + rest[lag];
  }
}

}  // namespace gyrod::core::GYROD_KERNEL
