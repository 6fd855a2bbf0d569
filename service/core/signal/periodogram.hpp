/// Power spectrum of a short stretch of a signal, to be averaged over many.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/signal/real_transform.hpp"

namespace gyrod::core {

/// Periodogram of N samples, their straight line (least squares) taken away and a Hann taper laid over:
///   P_k = |sum_n h_n (x_n - line_n) e^(-2 pi i k n / N)|^2,   h_n ~ sin^2(pi (n + 1/2) / N),   sum h_n^2 = 1,   k = 0..N/2.
/// In unit^2 per sample: white noise of variance s^2 has E P_k = s^2 from k = 3 on; below that the line has taken its part.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
/// Source: Welch 1967.
class Periodogram {
 public:
  /// @pre samples is a power of two, at least 8
  explicit Periodogram(std::size_t samples);

  [[nodiscard]] std::size_t samples() const noexcept { return taper_.size(); }
  /// N/2 + 1.
  [[nodiscard]] std::size_t bins() const noexcept { return transform_.bins(); }

  /// Writes P_0 .. P_(N/2).
  /// @return (1/N) sum of (x_n - line_n)^2, unit^2, without the taper
  /// @pre x.size() == samples(), power.size() == bins(), x finite
  double transform(std::span<const double> x, std::span<double> power) noexcept;
  /// What the last P_k are the squares of, k = 0..N/2. Valid until the next transform().
  [[nodiscard]] std::span<const std::complex<double>> spectrum() const noexcept { return spectrum_; }

 private:
  std::vector<double> taper_;
  std::vector<double> tapered_;
  RealTransform transform_;
  std::vector<std::complex<double>> spectrum_;
};

}  // namespace gyrod::core
