/// The threads that make answers.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "monitor/http_exchange.hpp"
#include "monitor/polling.hpp"

namespace gyrod::monitor {

/// A request of the client with this number, and its answer.
struct Job {
  std::uint64_t client = 0;
  std::string request;
  std::string address;
};
struct Done {
  std::uint64_t client = 0;
  Reply reply;
};

/// Thread-safe.
class AnswerPool {
 public:
  /// Two scrapers and a person.
  static constexpr std::size_t kThreads = 3;

  /// @param done raised after each answer; all parameters outlive the pool
  AnswerPool(const Answerer& answer, Gate& gate, StreamHub& streams, WakeSignal& done);
  /// Stops.
  ~AnswerPool() { stop(); }
  AnswerPool(const AnswerPool&) = delete;
  AnswerPool& operator=(const AnswerPool&) = delete;

  void start();
  /// Waits for the answers at work. Can be called twice.
  void stop() noexcept;

  /// The caller keeps the number of open jobs small: none is refused.
  void add(Job job);
  [[nodiscard]] std::vector<Done> take_done();

 private:
  void work() noexcept;
  [[nodiscard]] bool wait_for(Job& job);

  const Answerer& answer_;
  Gate& gate_;
  StreamHub& streams_;
  WakeSignal& done_signal_;
  std::mutex mutex_;
  std::condition_variable condition_;
  bool stopping_ = false;  ///< guarded by the mutex, as the next two
  std::deque<Job> jobs_;
  std::vector<Done> done_;
  std::vector<std::thread> threads_;
};

}  // namespace gyrod::monitor
