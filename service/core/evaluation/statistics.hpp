/// Means, slopes and delays with their uncertainty, for errors that have a memory.
///
/// Standard errors come from sums over batches, which are taken for independent: right for any memory that is short against a batch.
/// Samples that are not finite in one of the series are left out. Functions are pure; they allocate their batches only.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "core/evaluation/contender.hpp"

namespace gyrod::core {

/// Of the jackknife's batches: longer than the memory of what estimators miss of slow motion.
inline constexpr std::size_t kBatchSeconds = 10;

/// A value and how well it is known.
struct Measured {
  double value = 0.0;
  double standard_error = 0.0;
};

/// Mean of a series; standard error from the batch sums B_b = sum_(t in b) (x[t] - mean):  sqrt(sum_b B_b^2) / N.
/// @param batch samples, at least 1  @return nothing for less than two batches with known samples
[[nodiscard]] std::optional<Measured> batch_mean(std::span<const double> x, std::size_t batch);

/// Slope of the least-squares line y = c + slope x; standard error from the slopes without one of the B batches each (jackknife):
///   sqrt((B - 1) / B sum_b (slope_(-b) - slope)^2).   Source: Efron, Stein 1981, Annals of Statistics 9(3).
/// A line goes nearly through a batch that holds most of what x varies, so residuals there would tell nothing of the error.
/// @return nothing where x is constant, with all batches or without one of them, or less than two are known  @pre x.size() == y.size()
[[nodiscard]] std::optional<Measured> batch_slope(std::span<const double> x, std::span<const double> y,
                                                  std::size_t batch);

/// Slope of y on x in slow motion: of means over a second, ten a second, with batches of 10 s. The means overlap as what is faster than a second is in
/// each of them by chance, as its phase falls; a sample that is not finite takes its seconds with it.
/// @return nothing for less than 20 s, and as of batch_slope()  @pre x.size() == y.size(), rate_hz > 0
[[nodiscard]] std::optional<Measured> slow_slope(std::span<const double> x, std::span<const double> y,
                                                 double rate_hz);

/// Whether a deviation, which is known to two standard errors, is within a limit: so as measured, where two standard errors are less than the limit, or
/// beyond it by more than these. @return nothing where that cannot be told
[[nodiscard]] std::optional<bool> within(const Measured& deviation, double limit) noexcept;

/// What became of a swing A sin(2 pi f t) that was added to an input: least squares of the output's change on sine, cosine and 1.
struct SwingResponse {
  double gain = 0.0;  ///< amplitude out / amplitude in
  double standard_error = std::numeric_limits<
      double>::infinity();     ///< of the gain, as of batch_slope(); infinite with less than two batches
  double delay_samples = 0.0;  ///< above 0: late; within half a period
};
/// @param frequency in cycles per sample  @param range of the record in which both are compared
/// @param batch samples, longer than the memory of what the fit leaves
/// @return nothing where less than one period is known  @pre amplitude > 0, 0 < frequency < 0.5, batch > 0
[[nodiscard]] std::optional<SwingResponse> swing_response(std::span<const double> change, SampleRange range,
                                                          double frequency, double amplitude,
                                                          std::size_t batch);

/// The shift of `estimate` against `truth` at which their correlation coefficient is greatest, in samples, above 0 where the estimate is
/// late; between samples by the parabola through the greatest and its neighbours. Standard error as of batch_slope(), infinite with less
/// than two batches: where hardly anything of the truth is in the estimate, or nothing in it is fast, the peak is broad.
/// @param range of the truth  @param max_lag largest shift that is tried, either way
/// @return nothing where there is no peak inside: a constant, or a correlation that grows to the last shift
[[nodiscard]] std::optional<Measured> correlation_peak(std::span<const double> truth,
                                                       std::span<const double> estimate, SampleRange range,
                                                       std::size_t max_lag, std::size_t batch);

}  // namespace gyrod::core
