/// Kalman filtering of a series on its AR, MA or ARMA model.
#pragma once

#include <cstddef>
#include <span>

#include "core/denoise/arma_model.hpp"
#include "core/denoise/riccati.hpp"

namespace gyrod::core {

/// The Kalman filter of an ARMA(p, q) process s in white noise, in its steady state, on Harvey's form with m = max(p, q + 1) states:
///   x[k] = A x[k-1] + g w[k],   z[k] = e1' x[k] + v[k],   w ~ N(0, q_w), v ~ N(0, r),
///   A = [a | I above 0], first column a_1..a_m, ones right above the diagonal;   g = (1, b_1, .., b_(m-1)),   s[k] = e1' x[k].
/// For q = 0 it is the filter of ArKalman on another basis, with the same output; for p = 0 A is a shift. Allocates nothing. Not
/// thread-safe; one object per worker.
/// Source: Harvey, "Forecasting, structural time series models and the Kalman filter", section 3.4; [Yang2019] eq. (6).
class ArmaKalman {
 public:
  /// Beyond it even a model with roots at ArModel::kMaxRootRadius has forgotten its start.
  static constexpr std::size_t kStartSamples = 32768;

  /// Solves for the steady-state gain K = X e1 / (e1' X e1 + r).
  /// @param model            stationary; q + 1 <= kMaxArOrder, which kMaxMaOrder ensures
  /// @param driving_variance q_w, @param noise_variance r; unit^2, finite
  /// @return false where there is no such filter to use: q_w or r not positive, or the Riccati equation did not settle
  [[nodiscard]] bool design(const ArmaModel& model, double driving_variance, double noise_variance) noexcept;

  /// Filters z in place: z[k] becomes the estimate of s[k] given z[0..k] and the start. The start is the state before z[0] that makes
  /// the sum of squared innovations of the first kStartSamples samples least: what the model cannot know of the past is taken from
  /// the data. (Started on the first samples as measured, a model with a root near 1 carries their noise for thousands of samples.)
  /// @pre design() returned true
  void filter(std::span<double> z) noexcept;

  /// K, m elements.
  [[nodiscard]] const StateVector& gain() const noexcept { return gain_; }
  /// Variance of the innovation z[k] - prediction, e1' X e1 + r.
  [[nodiscard]] double innovation_variance() const noexcept { return innovation_variance_; }
  /// Variance of the estimate's error, (1 - K_1) e1' X e1 = r K_1.
  [[nodiscard]] double error_variance() const noexcept { return error_variance_; }

 private:
  /// One step from the state after the sample before. @return the innovation
  double step(StateVector& state, double measured) const noexcept;
  [[nodiscard]] StateVector fitted_start(std::span<const double> z) const noexcept;

  StateVector a_;  ///< a_1 .. a_m, zeros beyond p
  StateMatrix covariance_;
  StateVector gain_;
  double innovation_variance_ = 0.0;
  double error_variance_ = 0.0;
};

}  // namespace gyrod::core
