/// What autocorrelation and partial autocorrelation say about the family of a series, [Yang2019] Table 2.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// Lags looked at.
inline constexpr std::size_t kEvidenceLags = 20;

/// ACF and PACF of a series with their confidence bands, and where each cuts off.
struct CorrelationEvidence {
  /// Lags that the series is long enough for, at most kEvidenceLags; the arrays below hold lag 1 at [0].
  std::size_t lags = 0;
  std::array<double, kEvidenceLags> acf{};   ///< rho_1 ..
  std::array<double, kEvidenceLags> pacf{};  ///< phi_11 ..
  /// 95 % band of rho_l, +-, if the ACF cuts off before lag l: 1.96 sqrt((1 + 2 sum_(i<l) rho_i^2) / N) (Bartlett 1946).
  std::array<double, kEvidenceLags> acf_band{};
  /// 95 % band of every phi_ll beyond the order, +-: 1.96 / sqrt(N) (Quenouille 1949).
  double pacf_band = 0.0;
  /// Lag after which the function stays within kCutOffBand / 1.96 of its band up to the last lag: it cuts off. Nothing: it tails off.
  std::optional<std::size_t> acf_cut_off;
  std::optional<std::size_t> pacf_cut_off;
};

/// Width, in standard errors, of the band that decides on a cut-off. Wider than the 95 % of the plots: 20 lags must all stay inside,
/// which those of white noise do in 98 of 100 cases (at 1.96: in 36).
inline constexpr double kCutOffBand = 3.29;

/// @param acf     rho_0 .. of the series; lags beyond kEvidenceLags are not used
/// @param samples N of the series
/// Allocates nothing.
[[nodiscard]] CorrelationEvidence correlation_evidence(std::span<const double> acf,
                                                       std::size_t samples) noexcept;

/// [Yang2019] Table 2: PACF cuts off and ACF tails off: AR. ACF cuts off and PACF tails off: MA. Both tail off: ARMA. Both cut off:
/// the one that does so earlier (AR where equal); white where both do at lag 0. kNone without lags.
[[nodiscard]] ModelFamily family_by_correlations(const CorrelationEvidence& evidence) noexcept;

}  // namespace gyrod::core
