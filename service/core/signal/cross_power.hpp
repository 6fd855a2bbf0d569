/// What of one series others explain.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace gyrod::core {

/// Axes of a sensor.
inline constexpr std::size_t kSensorAxes = 3;

/// Sums of products of three series.
struct CrossPower {
  std::array<double, kSensorAxes> own{};     ///< of each with itself
  std::array<double, kSensorAxes> shared{};  ///< [i]: of the two others than i

  /// What is left of series i after the least squares of it on the two others, in parts of all of it, as it is in the mean where nothing is shared: the
  /// residual variance of n independent values on r series is (n - r) / n of the variance. At most n / (n - r); 1 where nothing can be told.
  /// With independent noise in each, no less is left in the mean than noise, whatever the motion: 1 / (S^-1)_ii >= N_ii for S = N + M, M >= 0.
  /// @param values n
  [[nodiscard]] double unexplained(std::size_t i, double values) const noexcept {
    // Series closer to one another than this are copies, and tell nothing: no two sensors have the same noise.
    constexpr double kCopy = 1e-10;
    const std::size_t j = (i + 1) % kSensorAxes;
    const std::size_t k = (i + 2) % kSensorAxes;
    const double ij = correlation(own[i], own[j], shared[k]);
    const double ik = correlation(own[i], own[k], shared[j]);
    const double jk = correlation(own[j], own[k], shared[i]);
    const bool first = 1.0 - ij * ij > kCopy && own[j] > 0.0;
    const bool second = 1.0 - ik * ik > kCopy && own[k] > 0.0;
    const bool both = first && second && 1.0 - jk * jk > kCopy;
    double left = 1.0;
    if (first) left = std::min(left, 1.0 - ij * ij);
    if (second) left = std::min(left, 1.0 - ik * ik);
    if (both)
      left = std::min(left, (1.0 + 2.0 * ij * ik * jk - ij * ij - ik * ik - jk * jk) / (1.0 - jk * jk));
    const double regressors = both ? 2.0 : (first || second ? 1.0 : 0.0);
    return values > regressors ? std::max(left, 0.0) * values / (values - regressors) : 1.0;
  }

 private:
  [[nodiscard]] static double correlation(double a, double b, double ab) noexcept {
    const double power = std::sqrt(a) * std::sqrt(b);
    const double value = ab / power;
    return power > 0.0 && std::isfinite(value) ? value : 0.0;
  }
};

}  // namespace gyrod::core
