// The slope method: lines of the five slopes, read at their times.
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/allan/noise_coefficients.hpp"

namespace gyrod::core {
namespace {

constexpr double kSlopeTolerance = 0.1;
constexpr double kLeastDecades = 1.0 / 3.0;
/// Half the width of the window in which a local slope is taken.
constexpr double kWindowDecades = 1.0 / 3.0;
/// With fewer degrees of freedom chance alone tilts a piece of the curve by several tenths.
constexpr double kFewestDegrees = 20.0;

/// A point in log-log coordinates.
struct LogPoint {
  double tau = 0.0;  ///< log10 of s
  double deviation = 0.0;
  double edf = 0.0;
};

std::vector<LogPoint> in_decades(std::span<const AllanPoint> points) {
  std::vector<LogPoint> logs;
  for (const AllanPoint& point : points) {
    if (!(point.deviation > 0.0) || point.edf < kFewestDegrees) continue;
    logs.push_back({std::log10(point.tau_s), std::log10(point.deviation), point.edf});
  }
  return logs;
}

/// Slope of the straight line through the points around one; nothing where there are not two.
std::optional<double> local_slope(const std::vector<LogPoint>& points, double tau) {
  double count = 0.0;
  double sum_tau = 0.0;
  double sum_deviation = 0.0;
  double products = 0.0;
  double squares = 0.0;
  for (const LogPoint& point : points) {
    const double offset = point.tau - tau;
    if (std::abs(offset) > kWindowDecades) continue;
    count += 1.0;
    sum_tau += offset;
    sum_deviation += point.deviation;
    products += offset * point.deviation;
    squares += offset * offset;
  }
  const double denominator = count * squares - sum_tau * sum_tau;
  if (count < 2.0 || !(denominator > 0.0)) return std::nullopt;
  return (count * products - sum_tau * sum_deviation) / denominator;
}

/// The longest run of points whose local slope is near the one wanted.
std::span<const LogPoint> longest_run(const std::vector<LogPoint>& points, const std::vector<double>& slopes,
                                      double wanted) {
  const auto length = [&points](std::size_t first, std::size_t last) {
    return points[last].tau - points[first].tau;
  };
  std::span<const LogPoint> best;
  double longest = kLeastDecades;
  std::size_t first = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::abs(slopes[i] - wanted) <= kSlopeTolerance)) {
      first = i + 1;
    } else if (length(first, i) >= longest) {
      longest = length(first, i);
      best = std::span(points).subspan(first, i - first + 1);
    }
  }
  return best;
}

/// The line of exactly this slope through the run, read where the term alone has the coefficient's value.
Coefficient read_line(std::span<const LogPoint> run, double slope, NoiseTerm term) {
  double weights = 0.0;
  double sum = 0.0;
  double surest = 0.0;
  for (const LogPoint& point : run) {
    weights += point.edf;
    sum += point.edf * (point.deviation - slope * point.tau);
    surest = std::max(surest, point.edf);
  }
  const double at_one_second = std::pow(10.0, sum / weights);
  const double value = at_one_second / std::sqrt(variance_per_square(term, 1.0));
  return {value, value / std::sqrt(2.0 * surest), true};
}

}  // namespace

NoiseCoefficients slope_coefficients(std::span<const AllanPoint> points) {
  const std::vector<LogPoint> logs = in_decades(points);
  std::vector<double> slopes;
  slopes.reserve(logs.size());
  for (const LogPoint& point : logs) slopes.push_back(local_slope(logs, point.tau).value_or(std::nan("")));
  NoiseCoefficients coefficients;
  for (std::size_t t = 0; t < kNoiseTerms; ++t) {
    const double slope = 0.5 * static_cast<double>(t) - 1.0;
    const std::span<const LogPoint> run = longest_run(logs, slopes, slope);
    if (!run.empty()) coefficients.terms[t] = read_line(run, slope, static_cast<NoiseTerm>(t));
  }
  return coefficients;
}

}  // namespace gyrod::core
