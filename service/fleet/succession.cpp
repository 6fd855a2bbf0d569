#include "fleet/succession.hpp"

#include <algorithm>
#include <utility>

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
    found = watched_.emplace(sensor, Watched{.period_began_ns = now_ns}).first;
  }
  Watched& watched = found->second;
  if (now_ns - watched.period_began_ns >= kMemoryNs) {
    watched.least_before_ns = std::exchange(watched.least_delay_ns, INT64_MAX);
    watched.period_began_ns = now_ns;
  }
  const std::int64_t delay_ns = difference(now_ns, stamp_ns);
  watched.least_delay_ns = std::min(watched.least_delay_ns, delay_ns);
  const std::int64_t least_ns = std::min(watched.least_delay_ns, watched.least_before_ns);
  const std::int64_t above_ns = std::clamp<std::int64_t>(difference(delay_ns, least_ns), 0, kMostDoubtNs);
  watched.doubt_ns += (above_ns - watched.doubt_ns) / 64;
}

bool Succession::may_have_been_served(std::string_view sensor, std::int64_t stamp_ns,
                                      std::int64_t now_ns) noexcept {
  if (watched_.empty()) return false;
  const auto found = watched_.find(sensor);
  if (found == watched_.end()) return false;
  const Watched& watched = found->second;
  const std::int64_t sent_ns = sum(stamp_ns, std::min(watched.least_delay_ns, watched.least_before_ns));
  const bool before = watched.taken_ns != kNotTaken && now_ns - watched.taken_ns <= kLongestNs &&
                      sent_ns < watched.taken_ns + kMarginNs + watched.doubt_ns;
  if (!before) watched_.erase(found);
  return before;
}

}  // namespace gyrod::fleet
