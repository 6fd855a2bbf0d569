/// How far an estimate is from the truth.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/evaluation/contender.hpp"
#include "core/evaluation/statistics.hpp"

namespace gyrod::core {

/// Error of the angle that an estimate adds up to: sum (estimate - truth) / fs over windows that follow one another without overlap.
/// Windows with a sample that is not known are left out. Unit: that of the rates times seconds.
struct AngleError {
  std::size_t windows = 0;
  double rms = 0.0;
  double mean = 0.0;
  double std = 0.0;  ///< about the mean, divided by the number of windows
  double max_abs = 0.0;
};

/// All over the judged samples t at which truth and estimate are known. Rates in the unit of the record.
struct ErrorFigures {
  std::size_t samples = 0;        ///< judged
  std::size_t lost_truth = 0;     ///< in the range, truth NaN
  std::size_t lost_estimate = 0;  ///< in the range, truth known, no estimate
  double rmse = 0.0;              ///< sqrt(mean e^2), e = estimate - truth
  double rmse_without_bias =
      0.0;  ///< sqrt(mean (e - mean e)^2): for a truth that knows nothing of the sensor's bias
  std::optional<Measured> bias;  ///< mean e; nothing for records shorter than two batches
  std::optional<double>
      normalised_error;  ///< sqrt(mean (e / claimed std)^2): 1 where the claim is right, above: too bold
  std::optional<double> normalised_error_without_bias;  ///< the same of e - mean e
  std::optional<AngleError> angle_10s;                  ///< nothing: not one whole window
  std::optional<AngleError> angle_60s;
  std::optional<Measured>
      scale_factor;  ///< slope of the estimate on the truth, sample by sample; below 1 for what shrinks
  std::optional<Measured>
      peak_lag_samples;  ///< shift at which estimate and truth correlate most; above 0: late
};

struct ErrorOptions {
  double rate_hz = 100.0;
  SampleRange range;
  /// Batch of the standard errors, seconds; that of peak_lag_samples is ten times as long.
  double batch_s = 1.0;
  /// Largest shift for peak_lag_samples.
  std::size_t max_peak_lag = 64;
};

/// @pre contender.estimate (and its std) are as long as truth; rate_hz > 0
/// Where nothing is known: 0 samples, rmse NaN.
[[nodiscard]] ErrorFigures error_figures(std::span<const double> truth, const Contender& contender,
                                         const ErrorOptions& options);

/// Angle errors over windows of window_s. Nothing where not one is known in full.
[[nodiscard]] std::optional<AngleError> angle_error(std::span<const double> error, double rate_hz,
                                                    double window_s);

}  // namespace gyrod::core
