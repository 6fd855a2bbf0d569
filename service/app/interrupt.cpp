#include "app/interrupt.hpp"

#include <ctime>

namespace gyrod::app {

Interrupt::Interrupt() {
  sigemptyset(&signals_);
  // Shells start background jobs with SIGINT ignored, and an ignored signal is dropped even where it is waited for.
  for (const int number : {SIGINT, SIGTERM}) {
    std::signal(number, SIG_DFL);
    sigaddset(&signals_, number);
  }
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&signals_, SIGHUP);
  hold();
  // A reader that goes away (a pipe, a socket) is an error of that write, not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // likewise a file that may not grow
}

void Interrupt::let_through() noexcept { pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr); }

void Interrupt::hold() noexcept { pthread_sigmask(SIG_BLOCK, &signals_, nullptr); }

bool Interrupt::wait_for(std::chrono::nanoseconds timeout) noexcept {
  if (requested_) return true;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec limit{static_cast<std::time_t>(seconds.count()),
                       static_cast<long>((timeout - seconds).count())};
  if (sigtimedwait(&signals_, nullptr, &limit) > 0) requested_ = true;
  return requested_;
}

}  // namespace gyrod::app
