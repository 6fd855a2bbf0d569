/// The line in a sensor's own noise, and what may be it.
#pragma once

#include <optional>
#include <span>

#include "core/joint/spectral_mode.hpp"
#include "core/noise/noise_fit.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// A noise whose spectrum has a narrow peak, taken apart. Powers are in the noise's unit squared.
struct NoisePeak {
  double cycles = 0.0;   ///< the peak's frequency, cycles per sample
  double power = 0.0;    ///< variance of the line
  NoiseModel rest{};     ///< the noise without it
  NoiseSpectrum line{};  ///< what the line has of the noise's spectrum
};

/// The highest point above 1/40 cycle per sample, where slow noise does not count, if it stands 2.5 times as high as the mean of what is further away than a
/// quarter of its frequency. The line is what stands above the straight line between the spectrum's values 30 % below and above the peak: what is
/// known of the noise has been spread by 15 % of each frequency (noise/line_spread.hpp).
/// @return nothing where there is no such peak, or the rest is no usable noise
/// Allocates nothing; about 0.2 ms.
[[nodiscard]] std::optional<NoisePeak> find_noise_peak(const NoiseModel& noise) noexcept;

/// A mode near the line, and its variance.
struct ModeNearLine {
  SpectralMode* mode = nullptr;
  double power = 0.0;
};

/// Sets the share of each mode. A line's power in a window varies, and the shape that it is taken for is a guess: modes at its place are the rest of it,
/// up to a quarter of its power in all, first the narrowest, which are most like a line. A mode that is more than that is motion in part, and where
/// it is twice as much, all of it.
/// @param modes their powers above 0; reordered
void share_with_line(double line_power, std::span<ModeNearLine> modes) noexcept;

}  // namespace gyrod::core
