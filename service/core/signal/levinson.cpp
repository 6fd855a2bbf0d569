#include "core/signal/levinson.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace gyrod::core {
namespace {

using Coefficients = std::array<double, kMaxYuleWalkerOrder>;

}  // namespace

double levinson(std::span<const double> autocovariance, std::span<double> a) noexcept {
  assert(autocovariance.size() == a.size() + 1 && a.size() <= kMaxYuleWalkerOrder);
  std::ranges::fill(a, 0.0);
  double error = autocovariance[0];
  if (!(error > 0.0)) return 0.0;
  Coefficients before{};
  for (std::size_t m = 0; m < a.size(); ++m) {
    double reflection = autocovariance[m + 1];
    for (std::size_t i = 0; i < m; ++i) reflection -= a[i] * autocovariance[m - i];
    reflection /= error;
    const double next = error * (1.0 - reflection * reflection);
    if (!(next > 0.0)) break;
    std::copy_n(a.begin(), m, before.begin());
    for (std::size_t i = 0; i < m; ++i) a[i] = before[i] - reflection * before[m - 1 - i];
    a[m] = reflection;
    error = next;
  }
  return error;
}

double ar_variance_gain(std::span<const double> a) noexcept {
  assert(a.size() <= kMaxYuleWalkerOrder);
  Coefficients now{};
  Coefficients before{};
  std::ranges::copy(a, now.begin());
  double gain = 1.0;
  for (std::size_t m = a.size(); m > 0; --m) {
    const double reflection = now[m - 1];
    const double rest = 1.0 - reflection * reflection;
    if (!(rest > 0.0)) return std::numeric_limits<double>::infinity();
    gain /= rest;
    before = now;
    for (std::size_t i = 0; i + 1 < m; ++i) now[i] = (before[i] + reflection * before[m - 2 - i]) / rest;
  }
  return gain;
}

}  // namespace gyrod::core
