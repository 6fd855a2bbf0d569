/// Autocorrelation and partial autocorrelation of finite sequences, by FFT.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/signal/real_transform.hpp"

namespace gyrod::core {

/// Normalised autocorrelation function (ACF) of a sequence of N samples, the biased estimate, [Yang2019] eq. (3):
///   rho_l = sum_{n} z_n z_{n+l} / sum_n z_n^2,   z = x - mean(x),   l = 0..N-1,   rho_0 = 1.
/// Zero-padded to a power of two of at least 2N, so that nothing wraps around.
/// Sizes its workspace once; no call allocates after that. Not thread-safe; one object per worker.
class Autocorrelation {
 public:
  /// @param max_samples longest sequence that will be given, at least 1
  explicit Autocorrelation(std::size_t max_samples);

  /// Writes rho_0 .. rho_(acf.size()-1). A constant sequence has no ACF: rho_0 = 1 and zeros are written.
  /// @pre 1 <= x.size() <= max_samples, acf.size() <= x.size()
  void acf(std::span<const double> x, std::span<double> acf) noexcept;

  /// Variance of rho_0 .. rho_(N-1), what [Yang2019] compares with 0.001; 0 for a constant sequence.
  /// Needs one transform only: by Parseval sum rho^2 follows from the squared power spectrum, and the sum of
  /// rho over all lags is zero because the mean was removed.
  /// @pre 1 <= x.size() <= max_samples
  [[nodiscard]] double acf_variance(std::span<const double> x) noexcept;

 private:
  void power_spectrum(std::span<const double> x) noexcept;

  std::vector<double> padded_;
  RealTransform transform_;
  std::vector<std::complex<double>> spectrum_;
};

/// Partial autocorrelation phi_11 .. phi_pp from an ACF, by the Durbin-Levinson recursion.
/// @param acf  rho_0 .. rho_p, p = pacf.size(); the autocorrelation of a stationary process or a biased
/// estimate
/// @param pacf receives phi_ll for l = 1..p; zeros once the prediction error has vanished
/// @pre acf.size() > pacf.size(), pacf.size() <= 256; allocates nothing
/// Source: Durbin 1960; Box, Jenkins, "Time series analysis", appendix A3.2.
void partial_autocorrelation(std::span<const double> acf, std::span<double> pacf) noexcept;

}  // namespace gyrod::core
