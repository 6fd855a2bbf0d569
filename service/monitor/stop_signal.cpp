#include "monitor/stop_signal.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <poll.h>
#include <sys/eventfd.h>
#include <system_error>

namespace gyrod::monitor {
namespace {

using std::chrono::milliseconds;

/// Longest single wait; the caller's loop goes on, so its length does not matter.
constexpr milliseconds kLongestPoll{60'000};

int milliseconds_until(Deadline deadline) {
  const auto left = std::chrono::ceil<milliseconds>(deadline - std::chrono::steady_clock::now());
  return static_cast<int>(std::clamp(left, milliseconds{0}, kLongestPoll).count());
}

}  // namespace

StopSignal::StopSignal() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!event_) throw std::system_error(errno, std::generic_category(), "eventfd");
}

void StopSignal::raise() noexcept { eventfd_write(event_.descriptor(), 1); }

bool StopSignal::raised() const noexcept {
  pollfd event{event_.descriptor(), POLLIN, 0};
  return poll(&event, 1, 0) > 0;
}

bool StopSignal::wait(int descriptor, short events, Deadline deadline) const noexcept {
  std::array<pollfd, 2> both{{{descriptor, events, 0}, {event_.descriptor(), POLLIN, 0}}};
  poll(both.data(), both.size(), milliseconds_until(deadline));
  return both[1].revents == 0 && both[0].revents != 0;
}

void StopSignal::pause(milliseconds time) const noexcept {
  pollfd event{event_.descriptor(), POLLIN, 0};
  poll(&event, 1, static_cast<int>(time.count()));
}

}  // namespace gyrod::monitor
