/// Amplitude spectral density of samples.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "live/sample_trail.hpp"

namespace gyrod::live {

/// One-sided, after Welch: the root of the mean power of half-overlapping stretches under a Hann taper, their lines taken away. White noise of
/// standard deviation s at rate f has s sqrt(2 / f) at every frequency; the lowest two are left out, of which the line has taken its part.
struct Spectrum {
  std::size_t samples = 0;                                 ///< in the stretches
  std::vector<double> frequency_hz;                        ///< above 0, up to half the rate
  std::array<std::vector<double>, stream::kAxes> density;  ///< (rad/s)/sqrt(Hz)
};

inline constexpr std::size_t kLeastStretch = 256;
inline constexpr std::size_t kMostStretch = 2048;

/// Samples of a stretch for so many in all: a power of two; four stretches or more where there is room. None below two of the shortest.
[[nodiscard]] std::optional<std::size_t> stretch_for(std::size_t samples) noexcept;

/// Stretches have no gap within (find_gaps()). None where there is no whole one. @pre stretch is a power of two, sample_rate_hz > 0
[[nodiscard]] std::optional<Spectrum> spectrum_of(std::span<const Point> points, double sample_rate_hz,
                                                  std::size_t stretch);

}  // namespace gyrod::live
