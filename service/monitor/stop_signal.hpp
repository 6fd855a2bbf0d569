/// Ends waits on sockets from another thread.
#pragma once

#include <chrono>

#include "monitor/socket.hpp"

namespace gyrod::monitor {

using Deadline = std::chrono::steady_clock::time_point;

/// Raised once, stays raised. Thread-safe.
class StopSignal {
 public:
  /// @throws std::system_error if the system has no descriptor left
  StopSignal();
  void raise() noexcept;
  [[nodiscard]] bool raised() const noexcept;

  /// Waits until `descriptor` has one of `events` (as for poll), the signal is raised, or the time is up.
  /// @return true if the descriptor is ready and the signal not raised
  [[nodiscard]] bool wait(int descriptor, short events, Deadline deadline) const noexcept;

  /// Waits for the signal alone.
  void pause(std::chrono::milliseconds time) const noexcept;

 private:
  Socket event_;
};

}  // namespace gyrod::monitor
