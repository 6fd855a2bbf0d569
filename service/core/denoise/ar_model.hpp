/// Autoregressive models: least squares by an orthogonal factorisation, order by BIC, always stable.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// What became of a fit.
enum class ArStatus : std::uint8_t {
  kFitted,    ///< least-squares model, roots inside the unit circle as found
  kDamped,    ///< the least-squares roots lay on or outside the circle; all were pulled in by one factor
  kConstant,  ///< the series does not vary: no model (order 0, innovation variance 0)
  kTooShort,  ///< fewer than ArFitter::kMinSamples samples: no model (order 0)
};

/// x[k] = a_1 x[k-1] + ... + a_p x[k-p] + w[k],   w ~ N(0, innovation_variance).
/// Every root of z^p - a_1 z^(p-1) - ... - a_p lies within kMaxRootRadius.
struct ArModel {
  /// Largest root radius: a mode that decays to 1/e in 10 000 samples still counts as an oscillation.
  static constexpr double kMaxRootRadius = 0.9999;

  ArStatus status = ArStatus::kTooShort;
  std::size_t order = 0;
  std::array<double, kMaxArOrder> a{};  ///< a[i-1] is a_i; zero beyond `order`
  double innovation_variance = 0.0;     ///< unit^2

  [[nodiscard]] std::span<const double> coefficients() const noexcept { return {a.data(), order}; }
};

/// True where every root of z^p - a_1 z^(p-1) - ... - a_p has modulus below `radius`, by the Schur-Cohn
/// step-down recursion.
/// @pre a.size() <= kMaxArOrder
[[nodiscard]] bool roots_within(std::span<const double> a, double radius) noexcept;

/// Pulls every root of z^p - a_1 z^(p-1) - ... - a_p towards 0 by one factor, a_i <- a_i f^i: the largest f in (0, 1), to one part in
/// 2^30, that brings all of them within the radius.
/// @pre a.size() <= kMaxArOrder, radius > 0
void pull_roots_within(std::span<double> a, double radius) noexcept;

/// Fits AR models to series of up to max_samples. Sizes its workspace once; fit() allocates nothing. Not
/// thread-safe.
///
/// All orders 1..P share the rows n = P..N-1 and one Householder factorisation [X | y] = Q R, from which
/// every residual sum of squares follows; the order is the minimum of [Yang2019] eq. (5), BIC(p) = N
/// ln(sigma_a^2) + p ln N. The factorisation works on X itself, never on X'X: a smooth IMF makes X'X singular
/// to rounding.
class ArFitter {
 public:
  static constexpr std::size_t kMinSamples = 8;

  /// @param max_samples longest series, at least kMinSamples
  /// @param max_order   P, 1..kMaxArOrder; a series of N samples is given orders up to N/4 only
  /// @throws std::invalid_argument for a max_order outside its range
  ArFitter(std::size_t max_samples, std::size_t max_order);

  /// Fits a zero-mean series. @pre x.size() <= max_samples, every value finite
  [[nodiscard]] ArModel fit(std::span<const double> x) noexcept;

 private:
  struct Factorisation {
    std::size_t rows = 0;
    std::size_t rank = 0;       ///< leading columns that are independent to rounding
    double residual_sum = 0.0;  ///< of the model with all `rank` columns
  };
  void fill_regression(std::span<const double> x, std::size_t order) noexcept;
  [[nodiscard]] Factorisation factorise(std::size_t rows, std::size_t order) noexcept;
  [[nodiscard]] std::size_t best_order(const Factorisation& qr) const noexcept;
  void back_substitute(const Factorisation& qr, ArModel& model) const noexcept;
  [[nodiscard]] double residual_sum(const Factorisation& qr, std::size_t order) const noexcept;

  std::size_t max_samples_;
  std::size_t max_order_;
  std::vector<double> columns_;  ///< column-major [lag 1 | ... | lag P | y], each of max_samples
};

}  // namespace gyrod::core
