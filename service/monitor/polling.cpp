#include "monitor/polling.hpp"

#include <algorithm>
#include <cerrno>
#include <sys/eventfd.h>
#include <system_error>

namespace gyrod::monitor {
namespace {

using std::chrono::milliseconds;

/// Longest single wait; the caller's loop goes on, so its length does not matter.
constexpr milliseconds kLongestPoll{60'000};

int milliseconds_until(Deadline deadline) {
  const Deadline now = std::chrono::steady_clock::now();
  if (deadline - now > kLongestPoll) return static_cast<int>(kLongestPoll.count());
  return static_cast<int>(std::max(std::chrono::ceil<milliseconds>(deadline - now), milliseconds{0}).count());
}

}  // namespace

WakeSignal::WakeSignal() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!event_) throw std::system_error(errno, std::generic_category(), "eventfd");
}

void WakeSignal::raise() noexcept { eventfd_write(event_.descriptor(), 1); }

void WakeSignal::clear() noexcept {
  eventfd_t raised = 0;
  (void)eventfd_read(event_.descriptor(), &raised);
}

void poll_until(std::span<pollfd> descriptors, Deadline deadline) noexcept {
  for (pollfd& each : descriptors) each.revents = 0;
  poll(descriptors.data(), descriptors.size(), milliseconds_until(deadline));
}

}  // namespace gyrod::monitor
