/// Estimation of AR, MA and ARMA models.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/denoise/arma_model.hpp"
#include "core/denoise/long_autoregression.hpp"
#include "core/denoise/tall_qr.hpp"

namespace gyrod::core {

/// Fits models of given orders to one series at a time, all over the same rows n = first_row() .. N-1, so that their residual sums
/// compare:
///   1. innovations by a long autoregression,
///   2. AR, MA and ARMA of every order by regression on the lags of the series and of these innovations: one orthogonal factorisation
///      serves all orders (Hannan, Rissanen 1982). For AR this is the least-squares estimate,
///   3. MA and ARMA from there to the least conditional sum of squares by Gauss-Newton, which is maximum likelihood but for the first
///      samples (Box, Jenkins, chapter 7): innovations start at zero, and the rows before first_row() only let that fade.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
class ArmaFitter {
 public:
  static constexpr std::size_t kMinSamples = 32;

  /// @param max_samples longest series
  /// @param max_p, max_q largest orders, at most kMaxArOrder and kMaxMaOrder
  ArmaFitter(std::size_t max_samples, std::size_t max_p, std::size_t max_q);

  /// Takes a series and does steps 1 and 2.
  /// @param x finite; its mean is removed. @pre x.size() <= max_samples
  /// @return kFitted, or why there is no model: kConstant, kTooShort
  [[nodiscard]] ArStatus start(std::span<const double> x) noexcept;

  [[nodiscard]] std::size_t first_row() const noexcept { return first_row_; }
  /// Rows that sums of squares are over.
  [[nodiscard]] std::size_t rows() const noexcept { return x_.size() - first_row_; }
  /// The largest orders that this series is long enough for.
  [[nodiscard]] std::size_t max_p() const noexcept { return max_p_; }
  [[nodiscard]] std::size_t max_q() const noexcept { return max_q_; }

  /// Innovation variance by step 2, unit^2; infinite where the regression is singular. @pre p <= max_p(), q <= max_q()
  [[nodiscard]] double regression_variance(std::size_t p, std::size_t q) const noexcept;

  /// The model of these orders by step 3; AR and white noise by step 2. status kTooShort where the regression is singular.
  /// @pre p <= max_p(), q <= max_q()
  [[nodiscard]] ArmaModel fit(std::size_t p, std::size_t q) noexcept;

  /// Innovations of a model over rows(), for a test of whiteness; valid until the next call.
  [[nodiscard]] std::span<const double> residuals(const ArmaModel& model) noexcept;

 private:
  [[nodiscard]] LeastSquares regression(std::size_t p, std::size_t q) const noexcept;
  void refine(ArmaModel& model) noexcept;
  [[nodiscard]] double filter(const ArmaModel& model) noexcept;
  [[nodiscard]] LeastSquares step(const ArmaModel& model) noexcept;
  [[nodiscard]] bool advance(ArmaModel& model, const LeastSquares& step, double& sum) noexcept;

  std::size_t limit_p_;
  std::size_t limit_q_;
  std::size_t max_p_ = 0;
  std::size_t max_q_ = 0;
  std::size_t first_row_ = 0;
  LongAutoregression long_autoregression_;
  TallQr qr_;
  RegressionMatrix lags_;       ///< R of [x lags | innovation lags | x]
  std::vector<double> series_;  ///< the series without its mean
  std::vector<double> w_;       ///< its innovations
  std::vector<double> u_;       ///< minus d w / d a_i, i samples earlier
  std::vector<double> v_;       ///< minus d w / d b_i, i samples earlier
  std::span<const double> x_;   ///< of series_, what is in use
};

}  // namespace gyrod::core
