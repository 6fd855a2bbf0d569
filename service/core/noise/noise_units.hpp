/// The level of a noise model in the units of data sheets, and back.
///
/// A sample of white noise at the rate f has the standard deviation  s = D sqrt(f / 2) = N sqrt(f):
///   D, noise density as data sheets give it, rms over the frequencies above 0: unit/sqrt(Hz);
///   N, angle random walk, the density over frequencies of both signs (IEEE Std 952): unit sqrt(s). deg/sqrt(h) are 60 times
///      deg/s/sqrt(Hz). Allan deviation, Kalibr's imu.yaml and our simulator mean this one.
/// A data sheet with 0.05 deg/s/sqrt(Hz) and 2 deg/sqrt(h) agrees with itself: 60 * 0.05 / sqrt(2) = 2.1 (ADIS16405; we measure 2.1).
#pragma once

#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// D of white noise with this standard deviation, unit/sqrt(Hz). For coloured noise the mean over all frequencies.
[[nodiscard]] double noise_density(const NoiseModel& model, double sample_rate_hz) noexcept;

/// N, unit sqrt(s): the density towards frequency 0, which is what integrates to angle.
[[nodiscard]] double angle_random_walk(const NoiseModel& model, double sample_rate_hz) noexcept;

/// White noise of density D at a sample rate. @pre both above 0
[[nodiscard]] NoiseModel from_noise_density(double density, double sample_rate_hz) noexcept;

/// White noise of angle random walk N at a sample rate. @pre both above 0
[[nodiscard]] NoiseModel from_angle_random_walk(double random_walk, double sample_rate_hz) noexcept;

/// White noise behind a sensor's own low-pass of second order, as it is where the filter stops nothing:
///   S(f) = white (sum over k of 1 / (1 + ((f + k rate) / bandwidth)^4) + 0.0003),   fitted by fit_noise():
/// what is faster than half the rate folds back, so that a wide low-pass leaves more than a narrow one at any rate.
/// Filters differ where they stop, and nobody knows what is left there: this is a guess, good enough to tell noise from motion where it passes.
/// @param bandwidth_hz at -3 dB
/// @pre white.white_variance, both frequencies above 0
[[nodiscard]] NoiseModel behind_low_pass(const NoiseModel& white, double bandwidth_hz,
                                         double sample_rate_hz) noexcept;

/// Correlation of neighbouring samples, -1..1; 0 for white noise and for a model that is not usable.
[[nodiscard]] double lag_one_correlation(const NoiseModel& model) noexcept;

/// The model for another sample rate of the same sensor: unchanged where the rates differ by 2 % at most, else white noise of the same
/// mean density, for a colour in samples does not carry over. Lines keep their power, as white noise.
/// @pre both rates above 0
[[nodiscard]] NoiseModel at_rate(const NoiseModel& model, double from_hz, double to_hz) noexcept;

}  // namespace gyrod::core
