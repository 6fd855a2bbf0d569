/// Whether the residuals of a model look like white noise: is the model adequate?
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// Lags that are tested beyond the number of parameters, which leaves as many degrees of freedom. 20 is the usual choice for data
/// without a season (Box, Jenkins): enough to see a wrong order, few enough to keep the test's power.
inline constexpr std::size_t kWhitenessFreedom = 20;

struct Whiteness {
  /// Lags h that were tested; 0: the series is too short to test.
  std::size_t lags = 0;
  /// Ljung-Box: Q = N (N + 2) sum_(l=1..h) rho_l^2 / (N - l), chi-square with h - p - q degrees of freedom if white.
  double ljung_box_q = 0.0;
  std::size_t degrees_of_freedom = 0;
  /// Probability of a Q at least as large if the residuals are white.
  double p_value = 0.0;
  /// p_value >= 0.05.
  bool adequate = false;
  /// The paper's criterion: how many of the h autocorrelations lie outside +-1.96 / sqrt(N) ...
  std::size_t lags_outside = 0;
  /// ... which white noise keeps to at most 1 + h/10, rounded down (3 of 20), in 98 of 100 cases.
  bool within_bands = false;
};

/// @param acf        rho_0 .. of the residuals; as many as whiteness_lags() + 1, or more
/// @param samples    N of the residuals
/// @param parameters p + q of the model that left them
/// Allocates nothing. Source: Ljung, Box 1978, "On a measure of lack of fit in time series models".
[[nodiscard]] Whiteness test_whiteness(std::span<const double> acf, std::size_t samples,
                                       std::size_t parameters) noexcept;

/// h = p + q + kWhitenessFreedom, at most N / 4; 0 where that leaves no degree of freedom.
[[nodiscard]] std::size_t whiteness_lags(std::size_t samples, std::size_t parameters) noexcept;

}  // namespace gyrod::core
