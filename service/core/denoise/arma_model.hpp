/// Autoregressive moving-average models.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "core/denoise/ar_model.hpp"
#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// x[k] = a_1 x[k-1] + ... + a_p x[k-p] + w[k] + b_1 w[k-1] + ... + b_q w[k-q],   w ~ N(0, innovation_variance).
/// q = 0 is AR(p), p = 0 is MA(q), p = q = 0 is white noise. Stationary and invertible: every root of
/// z^p - a_1 z^(p-1) - ... - a_p and of z^q + b_1 z^(q-1) + ... + b_q lies within ArModel::kMaxRootRadius.
struct ArmaModel {
  /// kDamped: roots lay on or outside the circle and were pulled in.
  ArStatus status = ArStatus::kTooShort;
  std::size_t p = 0;
  std::size_t q = 0;
  std::array<double, kMaxArOrder> a{};  ///< a[i-1] is a_i; zero beyond p
  std::array<double, kMaxMaOrder> b{};  ///< b[i-1] is b_i; zero beyond q
  /// Standard errors of a and b, from the curvature of the sum of squares at its minimum; zero beyond p and q.
  std::array<double, kMaxArOrder> a_error{};
  std::array<double, kMaxMaOrder> b_error{};
  double innovation_variance = 0.0;  ///< unit^2

  [[nodiscard]] std::span<const double> ar() const noexcept { return {a.data(), p}; }
  [[nodiscard]] std::span<const double> ma() const noexcept { return {b.data(), q}; }
  /// kNone where there is no model (constant or too short).
  [[nodiscard]] ModelFamily family() const noexcept;
};

/// "none", "white", "AR", "MA" or "ARMA".
[[nodiscard]] std::string_view name_of(ModelFamily family) noexcept;

/// True where every root of z^q + b_1 z^(q-1) + ... + b_q has modulus below `radius`: the model's own noise can be told from
/// its past.
/// @pre b.size() <= kMaxMaOrder
[[nodiscard]] bool invertible_within(std::span<const double> b, double radius) noexcept;

/// The innovations that the model makes of a zero-mean series, by its own recursion from w = 0 and x = 0 before the first sample:
///   w[k] = x[k] - sum a_i x[k-i] - sum b_i w[k-i].
/// Allocates nothing. `w` may be `x` itself only for p = q = 0.
/// @pre w.size() == x.size()
void innovations(const ArmaModel& model, std::span<const double> x, std::span<double> w) noexcept;

}  // namespace gyrod::core
