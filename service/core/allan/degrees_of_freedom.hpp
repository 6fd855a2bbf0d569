/// How sure an overlapping Allan variance is: the kind of noise at a cluster time, and the degrees of freedom that
/// follow from it.
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// Power-law noise by the exponent of its spectrum as a rate, S(f) ~ f^alpha.
enum class PowerLaw {
  kQuantization = 2,  ///< white angle noise
  kWhite = 0,         ///< angle random walk
  kFlicker = -1,      ///< bias instability
  kRandomWalk = -2,   ///< rate random walk, and whatever is steeper: ramps
};

/// Fewer clusters than this do not tell the kind of noise.
inline constexpr std::size_t kClustersToIdentify = 30;

/// The kind of noise that dominates at a cluster size, by the lag-1 autocorrelation r_1 of the cluster means: with
/// delta = r_1 / (1 + r_1), the means are differenced d <= 2 times until delta < 1/4; alpha = -2 (delta + d),
/// rounded to a kind. Between white and quantization noise white is taken from alpha < 3/2: its interval is the
/// wider one.
/// @param sums  x_0 .. x_N of the rate with its mean removed
/// @param cluster_samples m  @pre N / m >= kClustersToIdentify
/// @param work  at least N / m numbers, overwritten
/// Source: Riley, Greenhall, "Power law noise identification using the lag 1 autocorrelation", 18th EFTF, 2004.
[[nodiscard]] PowerLaw identify_noise(std::span<const double> sums, std::size_t cluster_samples,
                                      std::span<double> work) noexcept;

/// Equivalent degrees of freedom of the average of M squares z_k^2, z_k = x_{k+2m} - 2 x_{k+m} + x_k, which are
/// Gaussian with autocorrelation rho:
///   edf = M / sum_{|l|<M} (1 - |l|/M) rho(l/m)^2,
///   rho(u) ~ 6 s(u) - 4 s(u+1) - 4 s(u-1) + s(u+2) + s(u-2),
/// s the generalised autocovariance of the integrated rate: -|u|, u^2 ln|u|, |u|^3 for white, flicker, random walk,
/// a spike at 0 for quantization. At least 1. The sum is made in steps of m/64 where m is large.
/// @pre m >= 1, terms >= 1; allocates nothing
/// Source: Greenhall, Riley, "Uncertainty of stability variances based on finite differences", 35th PTTI, 2003.
[[nodiscard]] double equivalent_degrees_of_freedom(PowerLaw noise, std::size_t cluster_samples,
                                                   std::size_t terms) noexcept;

}  // namespace gyrod::core
