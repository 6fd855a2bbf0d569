/// The wish to end: Ctrl-C, SIGTERM, or the terminal going away (unless that is ignored, as under nohup).
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>

namespace gyrod::app {

/// Takes SIGINT, SIGTERM and SIGHUP out of the hands of the system, for this thread and all that it starts
/// later, and answers whether one has come. Make the one object before any thread. No code runs in a signal
/// handler.
class Interrupt {
 public:
  Interrupt();

  /// Lets signals end the process at once, for a wait that nobody can look out of; until hold().
  void let_through() noexcept;
  void hold() noexcept;

  /// Whether a signal has come; once true it stays true. Any thread.
  [[nodiscard]] bool requested() noexcept { return wait_for(std::chrono::milliseconds{0}); }

  /// Waits for a signal, no longer than that. Any thread. @return requested()
  bool wait_for(std::chrono::nanoseconds timeout) noexcept;

 private:
  sigset_t signals_{};
  std::atomic<bool> requested_{false};
};

}  // namespace gyrod::app
