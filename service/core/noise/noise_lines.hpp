/// The narrow lines in the spectrum of a sensor's noise.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/noise/axis_spectra.hpp"
#include "core/noise/noise_fit.hpp"

namespace gyrod::core {

/// Most lines of several axes that are told from a sensor's own.
inline constexpr std::size_t kMaxSharedLines = 5;

/// A spectrum taken apart.
struct SpectrumParts {
  NoiseSpectrum rest{};  ///< without the lines, shared ones, too: what surrounds them takes their place
  std::size_t line_count = 0;
  std::array<SpectralLine, kMaxNoiseLines> line{};  ///< by frequency, lowest first
  std::size_t shared_count = 0;
  std::array<SpectralLine, kMaxSharedLines>
      shared{};  ///< that other axes have, too: an engine's, not the sensor's. Strongest first
};

/// Finds lines, the one that stands out most first: a bin above 1/40 cycle per sample, where slow noise does not count, and below half a cycle, that no neighbour
/// exceeds and that stands 4 times as high as the floor, or 2 + 20 / segments times where that is more: the median of the bins within 20 % of the
/// frequency, 12 bins at least. Less than one in a thousand spectra of white noise has such a bin; a sine has it from 1.8 % of the noise's power on. The line
/// is what stands above the floor from there to where, on either side, less than half of the floor does, or to kLineSpread of the frequency. Its half width
/// is that of Cauchy's density which has this power and height behind the segments' taper.
/// @param segments that were averaged, half overlapping; above 0
/// Allocates nothing; about 0.1 ms.
[[nodiscard]] SpectrumParts take_lines(const NoiseSpectrum& power, double segments) noexcept;

/// The same of one axis of three. Its line is shared where AxisSpectra::shared_apart() is a quarter or more: the lines of a sensor's axes, each from its own drive,
/// know nothing of each other, those of an engine or a fan do, as it shakes all the sensor.
[[nodiscard]] SpectrumParts take_lines(const AxisSpectra& axes, std::size_t axis) noexcept;

/// What is known of a sensor's noise from its averaged spectrum: its lines, and white noise and AR(8) for the rest (fit_noise()).
/// @return nothing where the spectrum is zero or not finite
/// Allocates nothing.
[[nodiscard]] std::optional<NoiseModel> fit_noise_and_lines(const NoiseSpectrum& power,
                                                            double segments) noexcept;

/// The same of one axis of three, without the lines that are shared.
[[nodiscard]] std::optional<NoiseModel> fit_noise_and_lines(const AxisSpectra& axes,
                                                            std::size_t axis) noexcept;

/// Adds the model's lines to a spectrum, each a rectangle of its power and height: what take_lines() takes out again.
void add_lines(const NoiseModel& model, NoiseSpectrum& power) noexcept;

}  // namespace gyrod::core
