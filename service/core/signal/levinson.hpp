/// The Yule-Walker equations: from autocovariances to an autoregressive model and back.
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// Largest order that the functions here take.
inline constexpr std::size_t kMaxYuleWalkerOrder = 32;

/// Solves the Yule-Walker equations by the Levinson-Durbin recursion: the coefficients of
///   x[t] = a_1 x[t-1] + ... + a_p x[t-p] + w[t]
/// whose autocovariances at lags 0..p are the given ones. Stops early, with zeros behind, where the prediction error has vanished.
/// Every root of the result lies inside the unit circle if the autocovariances are those of a positive spectrum.
/// @param autocovariance r_0 .. r_p, unit^2, p = a.size()
/// @param a receives a_1 .. a_p
/// @return variance of w, unit^2; 0 where r_0 is not positive, and then a is zero
/// @pre autocovariance.size() == a.size() + 1, a.size() <= kMaxYuleWalkerOrder; allocates nothing
/// Source: Levinson 1947; Durbin 1960.
double levinson(std::span<const double> autocovariance, std::span<double> a) noexcept;

/// Variance of x per variance of w, by the step-down recursion: 1 / product of (1 - k_m^2) over the reflection coefficients.
/// @return infinity where a root of the model lies on or outside the unit circle; 1 for order 0
/// @pre a.size() <= kMaxYuleWalkerOrder; allocates nothing
[[nodiscard]] double ar_variance_gain(std::span<const double> a) noexcept;

}  // namespace gyrod::core
