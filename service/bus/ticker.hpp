/// Something that is done again and again. Internal to bus/.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

namespace gyrod::bus {

/// Calls work() on a thread of its own, with a pause after each call.
class Ticker {
 public:
  template <class Work>
  Ticker(double pause_s, Work work)
      : thread_([this, pause_s, work] {
          // Not a timed wait of the middleware: those go by the wall clock, which may be set.
          const std::chrono::duration<double> pause(pause_s);
          while (!stopping_.load(std::memory_order_relaxed)) {
            std::this_thread::sleep_for(pause);
            work();
          }
        }) {}
  ~Ticker() { stop(); }
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

  /// After a last call at the most. Idempotent.
  void stop() noexcept {
    stopping_.store(true, std::memory_order_relaxed);
    if (thread_.joinable()) thread_.join();
  }

 private:
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace gyrod::bus
