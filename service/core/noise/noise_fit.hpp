/// From the power spectrum of noise to its model.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Samples of one segment and bins of its spectrum, for all that learns noise here. 512 samples are 5 s at 100 Hz: what is slower
/// than a third of that counts as bias that drifts, not as noise.
inline constexpr std::size_t kNoiseSegment = 512;
inline constexpr std::size_t kNoiseBins = kNoiseSegment / 2 + 1;

/// Averaged power spectrum, unit^2 per sample, at bins 0..N/2 of N = kNoiseSegment samples.
using NoiseSpectrum = std::array<double, kNoiseBins>;

/// Fits white noise plus AR(8) to an averaged power spectrum S (core/signal/periodogram.hpp):
///   R0 = half the least of S, smoothed over 17 bins;   AR(8) by Yule-Walker from max(S - R0, 0).
/// Bins 0..2, where bias and its drift are, are replaced by the mean of bins 3..6. The model's variance is the mean of S, so that the
/// level does not depend on how well eight coefficients follow the spectrum.
/// @return nothing where S is zero or not finite
/// Allocates nothing; about 30 us.
/// Source: "white + AR" as Whittle-type spectrum splitting, Yule-Walker by Levinson 1947.
[[nodiscard]] std::optional<NoiseModel> fit_noise(const NoiseSpectrum& power) noexcept;

/// The same where the white part R0 is known, and the spectrum is good at its slow end. @pre white > 0
[[nodiscard]] std::optional<NoiseModel> fit_noise(const NoiseSpectrum& power, double white) noexcept;

}  // namespace gyrod::core
