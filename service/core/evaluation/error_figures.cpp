#include "core/evaluation/error_figures.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace gyrod::core {
namespace {

std::size_t samples_in(double seconds, double rate_hz) noexcept {
  return static_cast<std::size_t>(std::max(1LL, std::llround(seconds * rate_hz)));
}

/// Root mean square of what is finite; NaN where nothing is.
double finite_rms(std::span<const double> x) noexcept {
  double sum = 0.0;
  double count = 0.0;
  for (const double value : x) {
    if (!std::isfinite(value)) continue;
    sum += value * value;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : std::numeric_limits<double>::quiet_NaN();
}

void count_samples(std::span<const double> truth, std::span<const double> estimate,
                   ErrorFigures& figures) noexcept {
  for (std::size_t t = 0; t < truth.size(); ++t) {
    if (!std::isfinite(truth[t])) {
      ++figures.lost_truth;
    } else if (!std::isfinite(estimate[t])) {
      ++figures.lost_estimate;
    } else {
      ++figures.samples;
    }
  }
}

/// Less the mean of what is finite.
std::vector<double> without_finite_mean(std::vector<double> x) {
  double sum = 0.0;
  double count = 0.0;
  for (const double value : x) {
    if (!std::isfinite(value)) continue;
    sum += value;
    count += 1.0;
  }
  for (double& value : x) value -= sum / count;
  return x;
}

std::optional<double> normalised(std::span<const double> error, std::span<const double> claimed) {
  std::vector<double> ratio(error.size());
  for (std::size_t t = 0; t < ratio.size(); ++t) ratio[t] = error[t] / claimed[t];
  const double rms = finite_rms(ratio);
  return std::isfinite(rms) ? std::optional(rms) : std::nullopt;
}

}  // namespace

std::optional<AngleError> angle_error(std::span<const double> error, double rate_hz, double window_s) {
  const std::size_t length = samples_in(window_s, rate_hz);
  AngleError figures;
  double squares = 0.0;
  for (std::size_t begin = 0; begin + length <= error.size(); begin += length) {
    const auto window = error.subspan(begin, length);
    const double angle = std::accumulate(window.begin(), window.end(), 0.0) / rate_hz;
    if (!std::isfinite(angle)) continue;
    ++figures.windows;
    figures.mean += angle;
    squares += angle * angle;
    figures.max_abs = std::max(figures.max_abs, std::abs(angle));
  }
  if (figures.windows == 0) return std::nullopt;
  const auto count = static_cast<double>(figures.windows);
  figures.mean /= count;
  figures.rms = std::sqrt(squares / count);
  figures.std = std::sqrt(std::max(0.0, squares / count - figures.mean * figures.mean));
  return figures;
}

ErrorFigures error_figures(std::span<const double> truth, const Contender& contender,
                           const ErrorOptions& options) {
  assert(contender.estimate.size() == truth.size() && options.rate_hz > 0.0);
  const std::size_t begin = std::min(options.range.begin, truth.size());
  const std::size_t length = std::min(options.range.end, truth.size()) - begin;
  const auto right = truth.subspan(begin, length);
  const auto estimate = std::span(contender.estimate).subspan(begin, length);
  std::vector<double> error(length);
  for (std::size_t t = 0; t < length; ++t) error[t] = estimate[t] - right[t];

  ErrorFigures figures;
  count_samples(right, estimate, figures);
  const std::size_t batch = samples_in(options.batch_s, options.rate_hz);
  figures.rmse = finite_rms(error);
  figures.bias = batch_mean(error, batch);
  const std::vector<double> unbiased = without_finite_mean(error);
  figures.rmse_without_bias = finite_rms(unbiased);
  if (contender.std) {
    const auto claimed = std::span(*contender.std).subspan(begin, length);
    figures.normalised_error = normalised(error, claimed);
    figures.normalised_error_without_bias = normalised(unbiased, claimed);
  }
  figures.angle_10s = angle_error(error, options.rate_hz, 10.0);
  figures.angle_60s = angle_error(error, options.rate_hz, 60.0);
  figures.scale_factor = batch_slope(right, estimate, batch);
  figures.peak_lag_samples =
      correlation_peak(truth, contender.estimate, {begin, begin + length}, options.max_peak_lag, 10 * batch);
  return figures;
}

}  // namespace gyrod::core
