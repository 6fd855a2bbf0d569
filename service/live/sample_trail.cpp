#include "live/sample_trail.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::live {

void SampleTrail::add(std::int64_t stamp_ns, const std::array<double, stream::kAxes>& rate_radps) noexcept {
  if (!std::ranges::all_of(rate_radps, [](double rate) { return std::abs(rate) <= kMostRadps; })) return;
  const std::uint64_t place = end_.load(std::memory_order_relaxed);
  if (place > 0 && stamp_ns <= last_ns_) {
    if (last_ns_ - stamp_ns <= kClockStepNs) return;
    begin_.store(place, std::memory_order_release);
  }
  last_ns_ = stamp_ns;
  claimed_.store(place + 1, std::memory_order_relaxed);
  // Who sees one of these values also sees the claim.
  Slot& written = slot(place);
  written.stamp_ns.store(stamp_ns, std::memory_order_release);
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    written.rate_radps[axis].store(static_cast<float>(rate_radps[axis]), std::memory_order_release);
  end_.store(place + 1, std::memory_order_release);
}

std::uint64_t SampleTrail::read(std::uint64_t from, std::vector<Point>& points) const {
  const std::uint64_t stop = end();
  const auto oldest = [this](std::uint64_t written) {
    return written > slots_.size() ? written - slots_.size() : std::uint64_t{0};
  };
  const std::uint64_t start =
      std::min(stop, std::max({from, oldest(stop), begin_.load(std::memory_order_acquire)}));
  const std::size_t before = points.size();
  points.reserve(before + static_cast<std::size_t>(stop - start));
  for (std::uint64_t place = start; place < stop; ++place) {
    const Slot& seen = slot(place);
    Point point;
    point.stamp_ns = seen.stamp_ns.load(std::memory_order_acquire);
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
      point.rate_radps[axis] = seen.rate_radps[axis].load(std::memory_order_acquire);
    points.push_back(point);
  }
  // What was overwritten meanwhile, or is of a clock that is no longer in use.
  const std::uint64_t valid =
      std::max(oldest(claimed_.load(std::memory_order_relaxed)), begin_.load(std::memory_order_acquire));
  if (valid > start) {
    const std::uint64_t spoilt = std::min(valid, stop) - start;
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(before);
    points.erase(first, first + static_cast<std::ptrdiff_t>(spoilt));
  }
  return stop;
}

}  // namespace gyrod::live
