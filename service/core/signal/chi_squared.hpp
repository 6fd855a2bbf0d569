/// The chi-squared distribution.
#pragma once

namespace gyrod::core {

/// P(chi-squared with `degrees` degrees of freedom <= x); by the incomplete gamma function, from
/// kNormalFromDegrees on by Wilson and Hilferty's cube root.
/// @pre degrees > 0, x >= 0
[[nodiscard]] double chi_squared_probability(double x, double degrees) noexcept;

/// P(that > x) = 1 - chi_squared_probability(x, degrees), without the loss of digits where it is small.
/// @pre degrees > 0, x >= 0
[[nodiscard]] double chi_squared_tail(double x, double degrees) noexcept;

/// The x with chi_squared_probability(x, degrees) = probability, to 1e-10 relative.
/// @pre degrees > 0, 0 < probability < 1
[[nodiscard]] double chi_squared_quantile(double probability, double degrees) noexcept;

/// From here on Wilson and Hilferty (1931) is within 1e-6 relative of the quantile for probabilities of 1e-4 to
/// 1 - 1e-4, and the series of the incomplete gamma function gets long.
inline constexpr double kNormalFromDegrees = 20'000.0;

}  // namespace gyrod::core
