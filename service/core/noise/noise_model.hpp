/// What is known of a channel's own noise: the level of its white part and its colour.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace gyrod::core {

/// Largest order of a noise model's coloured part.
inline constexpr std::size_t kMaxNoiseColour = 8;

/// Noise of a sensor at rest, at one sample rate:
///   n[t] = v[t] + u[t],   v ~ N(0, white_variance) white,
///   u[t] = c_1 u[t-1] + ... + c_p u[t-p] + w[t],   w ~ N(0, colour_variance),   p <= kMaxNoiseColour.
/// Roots of the coloured part lie inside the unit circle. Variances are per sample, in the unit of the data squared.
/// A plain value: copied, compared and passed around without allocating.
struct NoiseModel {
  double white_variance = 0.0;   ///< of v, R0; positive in a usable model
  double colour_variance = 0.0;  ///< of w; 0 for noise that is white, or whose colour is unknown
  std::size_t colour_order = 0;
  std::array<double, kMaxNoiseColour> colour{};  ///< c_1 .. c_p, zero beyond colour_order

  [[nodiscard]] std::span<const double> colour_coefficients() const noexcept {
    return {colour.data(), colour_order};
  }
  friend bool operator==(const NoiseModel&, const NoiseModel&) = default;
};

/// White noise of this variance, unit^2.
[[nodiscard]] NoiseModel white_noise(double variance) noexcept;

/// Power spectrum, unit^2 per sample, of the model at angular frequency w, rad per sample:
///   R(w) = white_variance + colour_variance / |1 - c_1 e^-iw - ... - c_p e^-ipw|^2.
/// White noise of variance s^2 has R(w) = s^2 at every w; the mean of R over 0..pi is the variance.
[[nodiscard]] double noise_spectrum(const NoiseModel& model, double radians) noexcept;

/// Variance of n, unit^2: white_variance plus the coloured part's stationary variance.
[[nodiscard]] double noise_variance(const NoiseModel& model) noexcept;

/// The same noise `factor` times as strong: variances times factor^2.
[[nodiscard]] NoiseModel scaled(const NoiseModel& model, double factor) noexcept;

/// Finite, white_variance > 0, colour_variance >= 0, the coloured part's roots inside the unit circle.
[[nodiscard]] bool is_usable(const NoiseModel& model) noexcept;

}  // namespace gyrod::core
