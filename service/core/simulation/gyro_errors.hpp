/// The errors of one gyro axis, sample by sample: what turns the true rate into the measured one.
///
///   measured = quantise(saturate(truth + bias + flicker + random walk + white))
///
/// Terms and coefficients as in IEEE Std 952-1997, annex C; the Allan variance of the sum at cluster time tau
/// is, before the converter,
///   sigma^2(tau) = N^2/tau + (2 ln2/pi) B^2 + K^2 tau/3        (B's term between the ends of its band, see
///   GyroErrors).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/simulation/random.hpp"

namespace gyrod::core {

/// Noise density in rad/s/sqrt(Hz) (which is rad/sqrt(s)) of an angle random walk given as data sheets do, in
/// deg/sqrt(h).
[[nodiscard]] constexpr double noise_density_of(double angle_random_walk_deg_per_sqrt_h) noexcept {
  constexpr double kRadPerDeg = 0.017453292519943295;
  constexpr double kSqrtSecondsPerSqrtHour = 60.0;
  return angle_random_walk_deg_per_sqrt_h * kRadPerDeg / kSqrtSecondsPerSqrtHour;
}

/// Defaults: an ADIS16405-class MEMS gyro. At 100 Hz its white noise has a standard deviation of 0.35 deg/s.
/// Source: what still recordings of that sensor show, and its data sheet (2 deg/sqrt(h), 0.007 deg/s, +-300
/// deg/s, 0.05 deg/s). Every value finite and not negative, except the bias; 0 switches a term off.
struct GyroErrorOptions {
  /// N: white noise density, rad/s/sqrt(Hz). Standard deviation of a sample: N sqrt(sample rate).
  double white_noise_density = noise_density_of(2.1);
  /// B: flicker noise (bias instability), rad/s. The Allan deviation's floor is 0.664 B.
  double bias_instability_radps = 1.8e-4;
  /// K: rate random walk, rad/s/sqrt(s). Starts at 0.
  double rate_random_walk = 5e-6;
  /// Constant bias, rad/s.
  double bias_radps = 0.0;
  /// Step of the converter, rad/s: the measured rate is the nearest whole multiple.
  double step_radps = 0.05 * 0.017453292519943295;
  /// Largest rate the sensor can tell, rad/s, both ways; 0: no limit.
  double range_radps = 300.0 * 0.017453292519943295;
};

/// No errors at all: measured = truth.
[[nodiscard]] constexpr GyroErrorOptions no_gyro_errors() noexcept { return {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}; }

/// One axis. Flicker is the sum of kFlickerStages first-order Gauss-Markov processes of equal variance (ln 10
/// / pi) B^2, whose time constants are 0.1 s * 10^i, up to 2.8 h: decades of corner frequencies add up to a
/// spectrum of B^2 / (2 pi f). Its Allan deviation is 0.664 B within 2 % for tau from 1 s to 2000 s (from the
/// processes' closed form) and falls off outside. It starts in its stationary state, so a record has a bias
/// of its own with standard deviation 2.1 B. Allocates nothing; copies are independent.
class GyroErrors {
 public:
  static constexpr std::size_t kFlickerStages = 6;

  /// @pre sample_rate_hz > 0, options within their ranges
  GyroErrors(const GyroErrorOptions& options, double sample_rate_hz, std::uint64_t seed) noexcept;

  /// The measured rate for a true one, rad/s. One call per sample.
  [[nodiscard]] double measure(double truth_radps) noexcept;

 private:
  /// One Gauss-Markov process: b[n+1] = decay b[n] + drive w[n], w white with variance 1.
  struct Stage {
    double decay = 0.0;
    double drive = 0.0;
    double value = 0.0;
  };

  void start_flicker(double sample_rate_hz) noexcept;
  [[nodiscard]] double next_flicker() noexcept;
  [[nodiscard]] double next_random_walk() noexcept;

  GyroErrorOptions options_;
  Random random_;
  double white_std_ = 0.0;
  double walk_step_ = 0.0;
  double walk_ = 0.0;
  std::array<Stage, kFlickerStages> flicker_{};
};

}  // namespace gyrod::core
