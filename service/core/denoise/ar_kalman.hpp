/// Kalman filtering of one IMF on its AR model.
#pragma once

#include <span>

#include "core/denoise/ar_model.hpp"
#include "core/denoise/riccati.hpp"

namespace gyrod::core {

/// The Kalman filter of an AR(p) process in white noise, in its steady state, on the companion form
///   x[k] = A x[k-1] + e1 w[k],   z[k] = e1' x[k] + v[k],   w ~ N(0, q), v ~ N(0, r),
/// with x[k] = (s[k], s[k-1], ..., s[k-p+1]). Source: [Yang2019] eq. (6) and section 2.3.
/// Allocates nothing. Not thread-safe; one object per worker.
class ArKalman {
 public:
  /// Solves for the steady-state gain K = X e1 / (e1' X e1 + r).
  /// @param a a_1..a_p, 1 <= p <= kMaxArOrder, roots inside the unit circle (ArModel guarantees it)
  /// @param q innovation variance, @param r measurement-noise variance; unit^2, finite
  /// @return false where there is no such filter to use: q or r not positive, or the Riccati equation did not
  /// settle
  [[nodiscard]] bool design(std::span<const double> a, double q, double r) noexcept;

  /// Filters z in place: z[k] becomes the estimate of s[k] given z[0..k]. The state starts at the first p
  /// samples as measured, which become their own estimates.
  /// @pre design() returned true
  void filter(std::span<double> z) noexcept;

  /// K, p elements.
  [[nodiscard]] const StateVector& gain() const noexcept { return gain_; }
  /// Variance of the innovation z[k] - prediction, e1' X e1 + r.
  [[nodiscard]] double innovation_variance() const noexcept { return innovation_variance_; }
  /// Variance of the estimate's error, (1 - K_1) e1' X e1 = r K_1.
  [[nodiscard]] double error_variance() const noexcept { return error_variance_; }

 private:
  StateSpace model_;
  StateMatrix covariance_;
  StateVector gain_;
  StateVector state_;
  double innovation_variance_ = 0.0;
  double error_variance_ = 0.0;
};

}  // namespace gyrod::core
