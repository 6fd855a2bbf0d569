/// A first estimate of a series' innovations: the long autoregression of Hannan and Rissanen.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::core {

/// Fits AR(h) by Burg's recursion for h = 0..H, H = min(kMaxOrder, N / 10), takes the h of least AIC, N ln(sigma_h^2) + 2 h, and gives its
/// forward prediction errors. Burg's reflections stay within the unit circle, whatever the series.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
/// Source: Burg 1975; Hannan, Rissanen 1982, "Recursive estimation of mixed autoregressive-moving average order", step 1.
class LongAutoregression {
 public:
  /// An MA(1) with a root at 0.9 is forgotten to 1e-3 after that.
  static constexpr std::size_t kMaxOrder = 64;

  explicit LongAutoregression(std::size_t max_samples);

  /// @param x zero-mean, finite
  /// @param w receives the innovations; w[0..h) are those of the lower orders
  /// @return h
  /// @pre x.size() == w.size() <= max_samples, not overlapping
  [[nodiscard]] std::size_t innovations(std::span<const double> x, std::span<double> w) noexcept;

 private:
  std::vector<double> backward_;
};

}  // namespace gyrod::core
