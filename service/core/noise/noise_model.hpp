/// What is known of a channel's own noise: the level of its white part, its colour and its narrow lines.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace gyrod::core {

/// Largest order of a noise model's coloured part.
inline constexpr std::size_t kMaxNoiseColour = 8;

/// Largest number of its lines.
inline constexpr std::size_t kMaxNoiseLines = 3;

/// How far a line may be from where it was seen, in parts of its frequency. Lines of MEMS gyros wander with temperature: that of an
/// ADIS16405 (imu1 z) falls from 22.5 to 19.7 Hz in the two hours after power-up, and wanders by a few per cent after that.
/// Chosen by joint_study (docs/measured.md, "Noise lines that wander"): 0.10 to 0.15 serve best, 0.25 is too wide.
inline constexpr double kLineSpread = 0.15;

/// A narrow line in a spectrum: of the sensor's drive, its clock, a supply.
struct SpectralLine {
  double cycles = 0.0;      ///< its frequency, cycles per sample, 0..0.5
  double half_width = 0.0;  ///< at half its height, cycles per sample, as far as its spectrum told; above 0
  double variance = 0.0;    ///< above 0
  friend bool operator==(const SpectralLine&, const SpectralLine&) = default;
};

/// Noise of a sensor at rest, at one sample rate: the sum of
///   v[t] ~ N(0, white_variance) white,
///   u[t] = c_1 u[t-1] + ... + c_p u[t-p] + w[t],   w ~ N(0, colour_variance),   p <= kMaxNoiseColour,
/// and narrow lines. Roots of the coloured part lie inside the unit circle. Variances are per sample, in the unit of the data squared.
/// A plain value: copied, compared and passed around without allocating.
struct NoiseModel {
  double white_variance = 0.0;   ///< of v, R0; positive in a usable model
  double colour_variance = 0.0;  ///< of w; 0 for noise that is white, or whose colour is unknown
  std::size_t colour_order = 0;
  std::array<double, kMaxNoiseColour> colour{};  ///< c_1 .. c_p, zero beyond colour_order
  std::size_t line_count = 0;
  std::array<SpectralLine, kMaxNoiseLines> line{};  ///< by frequency, lowest first; nothing beyond line_count

  [[nodiscard]] std::span<const double> colour_coefficients() const noexcept {
    return {colour.data(), colour_order};
  }
  [[nodiscard]] std::span<const SpectralLine> lines() const noexcept { return {line.data(), line_count}; }
  friend bool operator==(const NoiseModel&, const NoiseModel&) = default;
};

/// White noise of this variance, unit^2.
[[nodiscard]] NoiseModel white_noise(double variance) noexcept;

/// Power spectrum, unit^2 per sample, of the model at angular frequency w, rad per sample:
///   R(w) = white_variance + colour_variance / |1 - c_1 e^-iw - ... - c_p e^-ipw|^2 + sum of the lines' densities,
/// each line spread evenly over kLineSpread to both sides, as uncertain as its frequency is (spread_density()).
/// White noise of variance s^2 has R(w) = s^2 at every w; the mean of R over 0..pi is the variance.
[[nodiscard]] double noise_spectrum(const NoiseModel& model, double radians) noexcept;

/// A line's power spread evenly over the frequencies within kLineSpread of it, as far as half a cycle per sample: unit^2 per sample, at a
/// frequency in cycles per sample, 0..0.5.
[[nodiscard]] double spread_density(const SpectralLine& line, double cycles) noexcept;

/// The model without its lines.
[[nodiscard]] NoiseModel without_lines(const NoiseModel& model) noexcept;

/// Variance of n, unit^2: white_variance, the coloured part's stationary variance and the lines'.
[[nodiscard]] double noise_variance(const NoiseModel& model) noexcept;

/// The same noise `factor` times as strong: variances times factor^2.
[[nodiscard]] NoiseModel scaled(const NoiseModel& model, double factor) noexcept;

/// Finite, white_variance > 0, colour_variance >= 0, the coloured part's roots inside the unit circle, every line as SpectralLine has it.
[[nodiscard]] bool is_usable(const NoiseModel& model) noexcept;

}  // namespace gyrod::core
