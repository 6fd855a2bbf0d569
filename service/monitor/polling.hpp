/// Waiting for many sockets at once, and being woken from it.
#pragma once

#include <chrono>
#include <poll.h>
#include <span>

#include "monitor/socket.hpp"

namespace gyrod::monitor {

using Deadline = std::chrono::steady_clock::time_point;

/// Ends another thread's wait. Thread-safe.
class WakeSignal {
 public:
  /// @throws std::system_error if the system has no descriptor left
  WakeSignal();
  void raise() noexcept;
  void clear() noexcept;
  /// Readable while raised.
  [[nodiscard]] int descriptor() const noexcept { return event_.descriptor(); }

 private:
  Socket event_;
};

/// Waits until one is ready or the time is up; may return earlier.
void poll_until(std::span<pollfd> descriptors, Deadline deadline) noexcept;

}  // namespace gyrod::monitor
