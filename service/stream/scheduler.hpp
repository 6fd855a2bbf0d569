/// The pool of workers and the queue of channels that have windows to work on.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gyrod::stream {

class Channel;

/// Hands channels to workers, first come first served; a channel that has more work goes to the back, so that
/// no channel starves the others. A channel stands in the queue once at the most (Channel sees to it), so the
/// queue is sized once.
class Scheduler {
 public:
  /// Works on one window of the channel. Called in a worker, by its index.
  using Work = std::function<void(std::size_t worker, Channel& channel)>;

  /// @param capacity most channels that there will be
  /// @throws std::runtime_error where the system starts fewer threads than `workers`; those that run are ended
  Scheduler(std::size_t workers, std::size_t capacity, Work work);
  /// As stop().
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  /// The channel has a window to work on and does not stand in the queue.
  void ready(Channel& channel);

  /// Ends the workers after the window each is working on; what waits is left. May be called again.
  void stop();

  [[nodiscard]] std::size_t busy() const;

 private:
  void run(std::size_t worker);

  Work work_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Channel*> queue_;  ///< ring
  std::size_t first_ = 0;
  std::size_t waiting_ = 0;
  std::size_t busy_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gyrod::stream
