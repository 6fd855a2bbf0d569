#include "fleet/succession.hpp"

#include <algorithm>

namespace gyrod::fleet {
namespace {

/// Stamps come from outside and may be anything: wraps instead of overflowing.
std::int64_t sum(std::int64_t a, std::int64_t b) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
}
std::int64_t difference(std::int64_t a, std::int64_t b) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}

}  // namespace

void Succession::watch(std::string_view sensor, std::int64_t stamp_ns, std::int64_t now_ns) {
  auto found = watched_.find(sensor);
  if (found == watched_.end()) {
    if (watched_.size() == kMostSensors) return;
    found = watched_.emplace(sensor, Watched{}).first;
  }
  std::int64_t& least = found->second.least_delay_ns;
  least = std::min(least, difference(now_ns, stamp_ns));
}

bool Succession::may_have_been_served(std::string_view sensor, std::int64_t stamp_ns,
                                      std::int64_t now_ns) noexcept {
  if (watched_.empty()) return false;
  const auto found = watched_.find(sensor);
  if (found == watched_.end()) return false;
  const Watched& watched = found->second;
  const std::int64_t sent_ns = sum(stamp_ns, watched.least_delay_ns);
  const bool before = watched.taken_ns != kNotTaken && now_ns - watched.taken_ns <= kLongestNs &&
                      sent_ns < watched.taken_ns + kMarginNs;
  if (!before) watched_.erase(found);
  return before;
}

}  // namespace gyrod::fleet
