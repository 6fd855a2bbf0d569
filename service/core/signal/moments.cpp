#include "core/signal/moments.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "core/signal/sums.hpp"

namespace gyrod::core {

double mean(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  // Counted from the first sample: the mean of a constant is then that constant and not a rounding beside it,
  // which variance, ACF and AR fit would take for a signal.
  const double first = x.front();
  const double sum = sum_of(x, [first](auto value) { return value - first; });
  return first + sum / static_cast<double>(x.size());
}

double variance(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  const double centre = mean(x);
  const double sum = sum_of(x, [centre](auto value) { return (value - centre) * (value - centre); });
  return sum / static_cast<double>(x.size());
}

double mean_square(std::span<const double> x) noexcept {
  if (x.empty()) return 0.0;
  return sum_of(x, [](auto value) { return value * value; }) / static_cast<double>(x.size());
}

double pearson_correlation(std::span<const double> x, std::span<const double> y) noexcept {
  assert(x.size() == y.size());
  const double mean_x = mean(x);
  const double mean_y = mean(y);
  const double xx = sum_of(x, [mean_x](auto a) { return (a - mean_x) * (a - mean_x); });
  const double yy = sum_of(y, [mean_y](auto b) { return (b - mean_y) * (b - mean_y); });
  const double xy = sum_of(x, y, [mean_x, mean_y](auto a, auto b) { return (a - mean_x) * (b - mean_y); });
  const double scale = std::sqrt(xx) * std::sqrt(yy);
  return scale > 0.0 ? std::clamp(xy / scale, -1.0, 1.0) : 0.0;
}

double mean_period(std::span<const double> x) noexcept {
  // A zero has no sign: it takes that of the sample before. Noise has next to none, and then no branch depends on the data.
  const bool has_zero = std::ranges::find(x, 0.0) != x.end();
  std::size_t changes = 0;
  if (has_zero) {
    double last = 0.0;  // no sign yet
    for (const double value : x) {
      if (value == 0.0) continue;
      if (last != 0.0 && (last < 0.0) != (value < 0.0)) ++changes;
      last = value;
    }
  } else {
    for (std::size_t n = 1; n < x.size(); ++n) changes += (x[n] < 0.0) != (x[n - 1] < 0.0) ? 1U : 0U;
  }
  return 2.0 * static_cast<double>(x.size()) / static_cast<double>(std::max<std::size_t>(changes, 1));
}

}  // namespace gyrod::core
