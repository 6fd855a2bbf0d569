/// A narrow tone in a window: an engine, a fan, a rotor.
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// A sinusoid; amplitude 0 where there is none.
struct Tone {
  double frequency_cycles = 0.0;  ///< cycles per sample
  double amplitude = 0.0;         ///< in the unit of the periodogram's square root
};

/// The strongest line of a periodogram: the highest bin that stands at least kToneRatio above the median of its neighbourhood on both
/// sides. Amplitude and frequency are the power and the centre of gravity of the line above that median.
/// @param periodogram bins 0 .. n/2 of a window of n samples, as RecencyTapers::spectrum() gives it, in parts of anything
/// @return a tone of amplitude 0 where no bin stands out; tones slower than 16 periods a window are motion, and not looked for
/// Allocates nothing; pure.
[[nodiscard]] Tone find_tone(std::span<const double> periodogram) noexcept;

/// A line's peak above the median around it: of 10 000 windows of white noise of 1024 samples and two tapers the largest peak was below
/// 11 medians in all but a few (tests/unit/core/joint/tone_test.cpp).
inline constexpr double kToneRatio = 25.0;

}  // namespace gyrod::core
