#include "live/rest_trail.hpp"

#include <algorithm>

namespace gyrod::live {

void RestTrail::note(std::int64_t stamp_ns, bool at_rest) noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  if (last_ns_ && stamp_ns < *last_ns_) {  // another clock
    begun_ = 0;
    at_rest_ = false;
    last_ns_.reset();
  }
  if (at_rest) {
    if (!at_rest_) ring_[begun_++ % kMost] = {last_ns_.value_or(stamp_ns), stamp_ns};
    ring_[(begun_ - 1) % kMost].end_ns = stamp_ns;
  }
  at_rest_ = at_rest;
  last_ns_ = stamp_ns;
}

std::vector<Interval> RestTrail::since(std::int64_t stamp_ns) const {
  const std::lock_guard lock(mutex_);
  std::vector<Interval> found;
  for (std::size_t i = begun_ - std::min(begun_, kMost); i < begun_; ++i) {
    if (const Interval& rest = ring_[i % kMost]; rest.end_ns > stamp_ns) found.push_back(rest);
  }
  return found;
}

}  // namespace gyrod::live
