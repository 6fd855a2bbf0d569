/// A narrow tone in a window: an engine, a fan, a rotor.
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// A sinusoid; amplitude and prominence 0 where there is none.
struct Tone {
  double frequency_cycles = 0.0;  ///< cycles per sample
  double amplitude = 0.0;         ///< in the unit of the periodogram's square root
  double prominence = 0.0;        ///< the line's peak over what surrounds it
};

/// The line of a periodogram that stands out most: a bin that none within kToneReach exceeds, the largest in parts of the geometric mean
/// of the medians on both sides of it, which is what a slope, such as that of fast motion, has there. Amplitude and frequency are power
/// and centre of gravity of what stands above that mean.
/// @param periodogram bins 0 .. n/2 of a transform of n samples, as RecencyTapers::spectrum() gives it, in parts of anything
/// @return a tone of at least that prominence, or none; tones slower than 22 periods a transform are motion, and not looked for
/// Allocates nothing; pure.
[[nodiscard]] Tone find_tone(std::span<const double> periodogram, double least_prominence) noexcept;

/// Bins that a line spreads over to each side.
inline constexpr std::size_t kToneReach = 6;

/// From this prominence on a tone is more than chance: none of 10 000 windows of white noise (1024 samples, two tapers of recency 3) has a
/// line of 20, 54 have one of 12.
inline constexpr double kSureTone = 25.0;

}  // namespace gyrod::core
