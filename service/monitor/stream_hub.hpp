/// Serves all event streams.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "monitor/event_stream.hpp"
#include "monitor/polling.hpp"

namespace gyrod::monitor {

/// One thread. A source is asked only when its client has taken everything before, so what waits for a client
/// is at most what its source appended at once, and a slow one costs the others nothing.
class StreamHub {
 public:
  /// The right to one of the streams, from before its source is made until the client is gone.
  using Place = std::shared_ptr<const void>;

  explicit StreamHub(const StreamOptions& options = {}) : options_(options) {}
  /// Stops. After all places are given back.
  ~StreamHub() { stop(); }
  StreamHub(const StreamHub&) = delete;
  StreamHub& operator=(const StreamHub&) = delete;

  void start();
  /// Ends all streams; each source is asked once more, and what its client takes at once is sent. Can be called twice.
  void stop() noexcept;

  /// @return none where all are taken. Thread-safe.
  [[nodiscard]] Place reserve();
  /// Thread-safe.
  void add(EventStream stream);

 private:
  void serve() noexcept;
  void take_new_ones();
  void wait();
  void step() noexcept;

  StreamOptions options_;
  std::atomic<std::size_t> taken_{0};
  std::atomic<bool> stopping_{false};
  WakeSignal wake_;
  std::mutex mutex_;
  std::vector<EventStream> new_ones_;  ///< guarded by the mutex
  std::vector<EventStream> streams_;   ///< of the thread alone
  std::thread thread_;
};

}  // namespace gyrod::monitor
