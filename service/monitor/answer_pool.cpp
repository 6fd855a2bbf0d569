#include "monitor/answer_pool.hpp"

#include <exception>
#include <utility>

#include "monitor/background.hpp"

namespace gyrod::monitor {

AnswerPool::AnswerPool(const Answerer& answer, Gate& gate, StreamHub& streams, WakeSignal& done)
    : answer_(answer), gate_(gate), streams_(streams), done_signal_(done) {}

void AnswerPool::start() {
  while (threads_.size() < kThreads) threads_.emplace_back([this] { work(); });
}

void AnswerPool::stop() noexcept {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  condition_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  done_.clear();
}

void AnswerPool::add(Job job) {
  {
    const std::scoped_lock lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  condition_.notify_one();
}

std::vector<Done> AnswerPool::take_done() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(done_, {});
}

bool AnswerPool::wait_for(Job& job) {
  std::unique_lock lock(mutex_);
  condition_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
  if (stopping_) return false;
  job = std::move(jobs_.front());
  jobs_.pop_front();
  return true;
}

void AnswerPool::work() noexcept {
  run_in_background();
  HttpExchange exchange(answer_, gate_, streams_);
  for (Job job; wait_for(job);) {
    Done done{job.client, {}};
    try {
      done.reply = exchange.reply_to(job.request, job.address);
    } catch (const std::exception&) {
      done.reply =
          {};  // out of memory: this client is disconnected without an answer, the next one may fare better
    }
    {
      const std::scoped_lock lock(mutex_);
      done_.push_back(std::move(done));
    }
    done_signal_.raise();
  }
}

}  // namespace gyrod::monitor
