/// Noise models from a recording in which the sensor did not move.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/noise/noise_fit.hpp"
#include "core/noise/noise_lines.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Fewest samples that still_noise() takes: six segments, which give the level to about 3 %.
inline constexpr std::size_t kMinStillSamples = 2000;

/// A learned level is used this much higher, as an amplitude: a level that is too low costs more than one that is too high. Two
/// standard errors of the level after 60 s at 100 Hz (1 / sqrt(2 * 6000) = 0.9 % each), and what it drifts in hours.
inline constexpr double kNoiseMargin = 1.02;

/// Fits white noise, AR(8) and lines to a still stretch (fit_noise_and_lines()), from Hann-tapered segments of kNoiseSegment samples, half overlapping,
/// each without its straight line: mean, drift and what is slower than 200 samples do not count. A segment whose variance
/// exceeds 1.5 times the median (a shock) is left out. The model is the measured one, without kNoiseMargin.
/// @param still samples of one axis, finite, in any unit; the model is in that unit
/// @return nothing for fewer than kMinStillSamples, and where the samples do not change or mostly do not
/// Allocates; takes about 4 us per segment.
[[nodiscard]] std::optional<NoiseModel> still_noise(std::span<const double> still);

/// What is known of one axis of a sensor.
struct StillAxis {
  std::optional<NoiseModel> model;
  std::size_t shared_count = 0;
  /// Lines that another axis has, too, strongest first: of an engine or a fan, and not in the model.
  std::array<SpectralLine, kMaxSharedLines> shared{};
};

/// The same from several stretches of one axis, together of kMinStillSamples at least. No segment spans two.
[[nodiscard]] std::optional<NoiseModel> still_noise(std::span<const std::span<const double>> stretches);

/// Rates of x, y, z, of equal sizes; empty for an axis that is not there.
using AxisSamples = std::array<std::span<const double>, kSensorAxes>;

/// The same of a sensor's three axes at once.
[[nodiscard]] std::array<StillAxis, kSensorAxes> still_noise(std::span<const AxisSamples> stretches);

}  // namespace gyrod::core
