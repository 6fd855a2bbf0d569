#include "core/signal/moments.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace gyrod::core {

double mean(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  // Counted from the first sample: the mean of a constant is then that constant and not a rounding beside it,
  // which variance, ACF and AR fit would take for a signal.
  const double first = x.front();
  double sum = 0.0;
  for (const double value : x) sum += value - first;
  return first + sum / static_cast<double>(x.size());
}

double variance(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  const double centre = mean(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - centre) * (value - centre);
  return sum / static_cast<double>(x.size());
}

double mean_square(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return sum / static_cast<double>(x.size());
}

double pearson_correlation(std::span<const double> x, std::span<const double> y) noexcept {
  assert(x.size() == y.size());
  const double mean_x = mean(x);
  const double mean_y = mean(y);
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double dx = x[n] - mean_x;
    const double dy = y[n] - mean_y;
    xx += dx * dx;
    yy += dy * dy;
    xy += dx * dy;
  }
  const double scale = std::sqrt(xx) * std::sqrt(yy);
  return scale > 0.0 ? std::clamp(xy / scale, -1.0, 1.0) : 0.0;
}

double mean_period(std::span<const double> x) noexcept {
  std::size_t changes = 0;
  double last = 0.0;  // no sign yet
  for (const double value : x) {
    if (value == 0.0) continue;
    if ((last < 0.0 && value > 0.0) || (last > 0.0 && value < 0.0)) ++changes;
    last = value;
  }
  return 2.0 * static_cast<double>(x.size()) / static_cast<double>(std::max<std::size_t>(changes, 1));
}

}  // namespace gyrod::core
