#include "core/joint/knock_bridge.hpp"

#include <algorithm>
#include <cassert>

namespace gyrod::core {
namespace {

/// Samples on either side that a roughness is the mean of.
constexpr std::size_t kSmoothReach = 4;

}  // namespace

KnockBridge::KnockBridge(std::size_t max_samples)
    : roughness_(max_samples), sorted_(max_samples), knocked_(max_samples) {}

std::size_t KnockBridge::apply(std::span<double> window, const JointOptions& options) noexcept {
  assert(window.size() <= sorted_.capacity());
  if (window.size() < 4 * kSmoothReach) return 0;
  measure(window);
  sorted_.assign(roughness_.begin(), roughness_.end());
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::ranges::nth_element(sorted_, middle);
  const double median = *middle;
  if (!(median > 0.0)) return 0;
  const std::size_t count = mark(options.knock_tail * median, options.knock_ratio * median);
  if (count == 0 || static_cast<double>(count) > options.knock_share * static_cast<double>(window.size())) {
    return 0;
  }
  bridge(window);
  return count;
}

/// m of every sample; at the ends, where fewer second differences are, of those that are.
void KnockBridge::measure(std::span<const double> window) noexcept {
  const std::size_t count = window.size();
  roughness_.resize(count);
  sorted_.resize(count);
  for (std::size_t n = 1; n + 1 < count; ++n) {
    const double second = window[n - 1] - 2.0 * window[n] + window[n + 1];
    sorted_[n] = second * second;
  }
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t first = std::max<std::size_t>(n, kSmoothReach + 1) - kSmoothReach;
    const std::size_t last = std::min(n + kSmoothReach, count - 2);
    double sum = 0.0;
    for (std::size_t k = first; k <= last; ++k) sum += sorted_[k];
    roughness_[n] = sum / static_cast<double>(last - first + 1);
  }
}

/// Marks the runs above `tail` that reach `ratio` and are over, and counts their samples.
std::size_t KnockBridge::mark(double tail, double ratio) noexcept {
  knocked_.assign(roughness_.size(), 0);
  std::size_t marked = 0;
  for (std::size_t n = 0; n < roughness_.size();) {
    std::size_t end = n;
    double most = 0.0;
    while (end < roughness_.size() && roughness_[end] > tail) most = std::max(most, roughness_[end++]);
    if (most > ratio && end < roughness_.size()) {
      std::fill(knocked_.begin() + static_cast<std::ptrdiff_t>(n),
                knocked_.begin() + static_cast<std::ptrdiff_t>(end), 1);
      marked += end - n;
    }
    n = end + 1;
  }
  return marked;
}

void KnockBridge::bridge(std::span<double> window) const noexcept {
  const std::size_t count = window.size();
  for (std::size_t n = 0; n < count; ++n) {
    if (knocked_[n] == 0) continue;
    std::size_t end = n;
    while (knocked_[end] != 0) ++end;  // what is marked is over before the window is
    const double after = window[end];
    const double before = n > 0 ? window[n - 1] : after;
    const auto steps = static_cast<double>(end - n + 1);
    for (std::size_t k = n; k < end; ++k) {
      window[k] = before + (after - before) * static_cast<double>(k - n + 1) / steps;
    }
    n = end;
  }
}

}  // namespace gyrod::core
