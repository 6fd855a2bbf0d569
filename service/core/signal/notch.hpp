/// Takes a narrow band out of a stretch of samples.
#pragma once

#include <span>

namespace gyrod::core {

/// What a notch leaves of the samples, in place: zeros on the unit circle at the frequency, poles of radius r = e^(-2 pi half_width) behind
/// them, once forwards and once backwards, so that nothing is shifted in time:
///   y[n] = x[n] - 2 c x[n-1] + x[n-2] + 2 r c y[n-1] - r^2 y[n-2],   c = cos(2 pi cycles).
/// A tone at the frequency is gone, but for the first 1 / (2 pi half_width) samples from either end, which know too little of it; half_width away from it
/// the power is about a quarter; a constant and what is far away stays, within half_width / cycles.
/// @param samples finite, any number of them
/// @param cycles  cycles per sample, 0..0.5
/// @param half_width cycles per sample, above 0
/// Allocates nothing.
void notch(std::span<double> samples, double cycles, double half_width) noexcept;

}  // namespace gyrod::core
