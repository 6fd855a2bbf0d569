/// The five noise coefficients of a gyro from its Allan deviation, by three methods. All in SI units.
///
///   sigma^2(tau) = 3 Q^2/tau^2 + N^2/tau + (2 ln2/pi) B^2 + K^2 tau/3 + R^2 tau^2/2
///
/// Source: IEEE Std 952-1997, annex C. For an accelerometer read m/s for rad throughout.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/allan/allan_deviation.hpp"

namespace gyrod::core {

enum class NoiseTerm : std::size_t {
  kQuantization,     ///< Q, rad
  kAngleRandomWalk,  ///< N, rad/sqrt(s) = rad/s/sqrt(Hz): white noise of the rate
  kBiasInstability,  ///< B, rad/s: flicker noise; the floor of the deviation is 0.664 B
  kRateRandomWalk,   ///< K, rad/s/sqrt(s)
  kRateRamp,         ///< R, rad/s^2: drift
};

inline constexpr std::size_t kNoiseTerms = 5;

/// A number stands in `value` and `standard_error` only where `observable` is true; else both are 0.
struct Coefficient {
  double value = 0.0;
  double standard_error = 0.0;  ///< same unit as value
  bool observable = false;
};

struct NoiseCoefficients {
  std::array<Coefficient, kNoiseTerms> terms;

  [[nodiscard]] const Coefficient& operator[](NoiseTerm term) const noexcept {
    return terms[static_cast<std::size_t>(term)];
  }
  [[nodiscard]] Coefficient& operator[](NoiseTerm term) noexcept {
    return terms[static_cast<std::size_t>(term)];
  }
};

/// What one unit of a coefficient's square adds to sigma^2 at tau_s: 3/tau^2, 1/tau, 2 ln2/pi, tau/3, tau^2/2.
[[nodiscard]] double variance_per_square(NoiseTerm term, double tau_s) noexcept;

/// sigma(tau_s) of the model with the observable terms; 0 where there is none.
[[nodiscard]] double model_deviation(const NoiseCoefficients& coefficients, double tau_s) noexcept;

/// The primary fit: non-negative least squares on sigma^2.
///
/// Weights: one over the variance of a point, sigma^4 (2/edf + misfit^2), sigma^2 by the fitted model and found
/// by iteration (by the measured sigma^2 instead, low points would pull). misfit = 0.05: no sensor follows the
/// model to better than some per cent, and the short cluster times, known to a tenth of a per cent, would
/// otherwise rule the fit alone. Points more than 2 standard deviations off count less (Huber): a line in the
/// spectrum is a hump in the curve that no term can follow.
/// Not observable: the term whose square is least significant goes and the rest is fitted again, until all
/// stand 2.5 standard errors or more above 0, the error being what it would be if the term were not there.
/// Standard errors: the points of a curve go together; their correlation follows from the spectrum of the
/// fitted model (point_correlation.hpp). What dropping terms changed counts as error, too, and a fit that
/// leaves more than its errors explain has them widened.
/// The constants were chosen on simulated noise (docs/allan.md).
/// Fewer than 3 points with a deviation above 0: nothing is observable.
/// @param points from allan_deviation(), ascending in tau_s
[[nodiscard]] NoiseCoefficients fit_coefficients(std::span<const AllanPoint> points);

/// The slope method: where the log-log curve has slope -1, -1/2, 0, +1/2, +1 within 0.1 over a third of a
/// decade or more, the line of exactly that slope through these points, weighted by edf, is read at
///   Q: sqrt(3) s,   N: 1 s,   B: anywhere / sqrt(2 ln2/pi),   K: 3 s,   R: sqrt(2) s.
/// Elsewhere not observable. Other terms that add to the line are not taken off: it reads too high.
/// Standard error: that of the surest point on the line.
/// Source: IEEE Std 952-1997, annex C.
[[nodiscard]] NoiseCoefficients slope_coefficients(std::span<const AllanPoint> points);

/// The literature's polynomial fit: plain least squares of the deviation, not the variance,
///   sigma(tau) = sum_{n=-2}^{2} A_n tau^(n/2),
/// Q = A_-2 / sqrt(3), N = A_-1, B = A_0 / sqrt(2 ln2/pi), K = sqrt(3) A_1, R = sqrt(2) A_2, which in degrees and
/// hours are the usual Q = A_-2 / (3600 sqrt(3)), N = A_-1 / 60, K = 60 sqrt(3) A_1, R = 3600 sqrt(2) A_2.
/// For comparison with papers only: variances add, deviations do not, so terms take from one another, and a
/// coefficient may be negative. It is given as it comes. `observable`: there were the 6 points to fit.
[[nodiscard]] NoiseCoefficients polynomial_coefficients(std::span<const AllanPoint> points);

/// Standard deviation of the white noise of one sample, N sqrt(rate), in the unit of the rate.
[[nodiscard]] double white_noise_per_sample(double angle_random_walk, double sample_rate_hz) noexcept;
/// Standard deviation of a step of the rate random walk from one sample to the next, K / sqrt(rate).
[[nodiscard]] double random_walk_step_per_sample(double rate_random_walk, double sample_rate_hz) noexcept;
/// Standard deviation that angle quantization gives one rate sample, sqrt(2) Q rate.
[[nodiscard]] double quantization_per_sample(double quantization, double sample_rate_hz) noexcept;

/// A coefficient as data sheets give it: Q deg, N deg/sqrt(h), B deg/h, K deg/h^1.5, R deg/h^2.
/// @param value in rad and s
[[nodiscard]] double in_degrees_and_hours(NoiseTerm term, double value) noexcept;

}  // namespace gyrod::core
