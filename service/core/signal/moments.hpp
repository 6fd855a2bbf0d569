/// Moments of finite sequences. All functions are pure, allocate nothing and are safe to call from any
/// thread.
#pragma once

#include <span>

namespace gyrod::core {

/// Arithmetic mean (1/N) sum x_n, in the unit of x; exact for a constant one, 0 for an empty one.
[[nodiscard]] double mean(std::span<const double> x) noexcept;

/// Population variance (1/N) sum (x_n - mean)^2 by two passes, in the unit of x squared; 0 for an empty
/// sequence.
[[nodiscard]] double variance(std::span<const double> x) noexcept;

/// Mean square (1/N) sum x_n^2; 0 for an empty sequence.
[[nodiscard]] double mean_square(std::span<const double> x) noexcept;

/// Pearson correlation coefficient, [Yang2019] eq. (2):
///   PCC = sum (x_n - mean x)(y_n - mean y) / sqrt(sum (x_n - mean x)^2 sum (y_n - mean y)^2),   in [-1, 1].
/// 0 where either sequence is constant.
/// @pre x.size() == y.size()
[[nodiscard]] double pearson_correlation(std::span<const double> x, std::span<const double> y) noexcept;

/// Mean period 2 N / Z in samples, Z the number of sign changes (a zero takes the sign before it).
/// 2 N where there is none: the sequence is at most half an oscillation long.
[[nodiscard]] double mean_period(std::span<const double> x) noexcept;

}  // namespace gyrod::core
