#include "app/interrupt.hpp"

#include <csignal>
#include <ctime>

namespace gyrod::app {
namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};

sigset_t stop_signals() noexcept {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kSignals) sigaddset(&set, signal);
  return set;
}

}  // namespace

Interrupt::Interrupt() {
  // Shells start background jobs with SIGINT ignored, and an ignored signal is dropped even where it is
  // waited for.
  for (const int signal : kSignals) std::signal(signal, SIG_DFL);
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // A reader that goes away (a pipe, a socket) is an error of that write, not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
}

bool Interrupt::wait_for(std::chrono::nanoseconds timeout) noexcept {
  if (requested_) return true;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
  const timespec limit{static_cast<std::time_t>(seconds.count()),
                       static_cast<long>((timeout - seconds).count())};
  const sigset_t set = stop_signals();
  if (sigtimedwait(&set, nullptr, &limit) > 0) requested_ = true;
  return requested_;
}

}  // namespace gyrod::app
