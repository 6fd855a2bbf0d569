#include "core/denoise/long_autoregression.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/signal/moments.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

/// One step of the lattice, in place. Forward errors of sample n are at f[n]; the backward error that belongs to f[n] at order m is at
/// g[n - m], so that nothing has to be shifted.
void reflect(std::span<double> f, std::span<double> g, std::size_t order, double reflection) noexcept {
  for (std::size_t s = 0; s + order < f.size(); ++s) {
    const double forward = f[s + order];
    const double backward = g[s];
    f[s + order] = forward - reflection * backward;
    g[s] = backward - reflection * forward;
  }
}

/// Burg's reflection of this order: the least sum of forward and backward errors.
double reflection_of(std::span<const double> f, std::span<const double> g, std::size_t order) noexcept {
  const auto forward = f.subspan(order);
  const auto backward = g.first(forward.size());
  const double both = sum_of(forward, backward, [](auto a, auto b) { return a * a + b * b; });
  const double cross = sum_of(forward, backward, [](auto a, auto b) { return a * b; });
  return both > 0.0 ? std::clamp(2.0 * cross / both, -1.0, 1.0) : 0.0;
}

}  // namespace

LongAutoregression::LongAutoregression(std::size_t max_samples) : backward_(max_samples) {}

std::size_t LongAutoregression::innovations(std::span<const double> x, std::span<double> w) noexcept {
  assert(x.size() == w.size() && x.size() <= backward_.size());
  const std::span<double> g{backward_.data(), x.size()};
  const std::size_t highest = std::min(kMaxOrder, x.size() / 10);
  std::array<double, kMaxOrder> reflections{};

  std::ranges::copy(x, w.begin());
  std::ranges::copy(x, g.begin());
  std::size_t best = 0;
  double least_aic = 0.0;
  double aic = 0.0;
  for (std::size_t order = 1; order <= highest; ++order) {
    const double reflection = reflection_of(w, g, order);
    reflections[order - 1] = reflection;
    const double left = 1.0 - reflection * reflection;
    if (!(left > std::numeric_limits<double>::epsilon()))
      break;  // predicted to rounding: no innovations beyond
    aic += static_cast<double>(x.size()) * std::log(left) + 2.0;
    reflect(w, g, order, reflection);
    if (aic < least_aic) {
      least_aic = aic;
      best = order;
    }
  }

  std::ranges::copy(x, w.begin());
  std::ranges::copy(x, g.begin());
  for (std::size_t order = 1; order <= best; ++order) reflect(w, g, order, reflections[order - 1]);
  return best;
}

}  // namespace gyrod::core
