/// Overlapping Allan deviation of a uniformly sampled rate, with confidence intervals.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::core {

/// The deviation at one cluster time.
struct AllanPoint {
  double tau_s = 0.0;               ///< cluster time m / sample rate
  std::size_t cluster_samples = 0;  ///< m
  std::size_t terms = 0;            ///< M = N - 2 m + 1, the squares that are averaged
  double deviation = 0.0;           ///< in the unit of the rate
  double lower = 0.0;               ///< ends of the confidence interval of the deviation, same unit
  double upper = 0.0;
  double edf = 0.0;  ///< equivalent degrees of freedom of the variance, at least 1
};

struct AllanOptions {
  /// Cluster times go up to this part of the record; above 0, at most 0.5. Beyond a tenth the estimate rests
  /// on a handful of independent pieces.
  double longest_part = 0.1;
  /// Cluster times per decade, log-spaced and rounded to whole samples without repeats; 1..1000.
  int points_per_decade = 20;
  /// Confidence of the interval, above 0, below 1. Default: one standard deviation.
  double confidence = 0.6827;
};

/// The overlapping estimator: with x_k = sum_{n<k} (rate_n - mean) and M = N - 2 m + 1,
///   sigma^2(tau = m / rate) = 1 / (2 m^2 M) sum_{k=0}^{M-1} (x_{k+2m} - 2 x_{k+m} + x_k)^2.
/// Source: IEEE Std 952-1997, annex C; NIST SP 1065, chapter 5 (from phase data; its x is ours times 1 / rate).
///
/// The interval: edf sigma^2_estimated / sigma^2_true is taken as chi-squared with edf degrees of freedom, the
/// edf of the noise type found at that cluster time (degrees_of_freedom.hpp); where fewer than 30 clusters are left
/// to tell, the type found at the longest time with 30. Source: NIST SP 1065, chapter 5.
/// It holds for one cluster time, not for the whole curve at once.
///
/// A constant rate has deviation 0 everywhere. Fewer than 3 samples: no points.
/// Time about (points) N, memory N numbers. Pure; safe to call from any thread.
/// @param rate finite  @param sample_rate_hz above 0
/// @pre options within their ranges
[[nodiscard]] std::vector<AllanPoint> allan_deviation(std::span<const double> rate, double sample_rate_hz,
                                                      const AllanOptions& options = {});

/// The same at given cluster sizes. Sizes that need more than the record, 2 m > N, are left out.
/// @param cluster_samples each at least 1
[[nodiscard]] std::vector<AllanPoint> allan_deviation_at(std::span<const double> rate, double sample_rate_hz,
                                                         std::span<const std::size_t> cluster_samples,
                                                         double confidence = AllanOptions{}.confidence);

/// The cluster sizes that allan_deviation() takes for a record of this length, ascending from 1.
[[nodiscard]] std::vector<std::size_t> cluster_sizes(std::size_t samples, const AllanOptions& options);

}  // namespace gyrod::core
