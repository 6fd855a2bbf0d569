#include "stream/scheduler.hpp"

#include <cassert>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace gyrod::stream {

Scheduler::Scheduler(std::size_t workers, std::size_t capacity, Work work)
    : work_(std::move(work)), queue_(capacity) {
  threads_.reserve(workers);
  try {
    while (threads_.size() < workers)
      threads_.emplace_back([this, worker = threads_.size()] { run(worker); });
  } catch (const std::system_error& error) {
    const std::size_t started = threads_.size();
    stop();
    throw std::runtime_error("workers: thread " + std::to_string(started + 1) + " of " +
                             std::to_string(workers) + " does not start: " + error.code().message());
  }
}

Scheduler::~Scheduler() { stop(); }

void Scheduler::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

void Scheduler::ready(Channel& channel) {
  {
    const std::lock_guard lock(mutex_);
    assert(waiting_ < queue_.size());
    queue_[(first_ + waiting_) % queue_.size()] = &channel;
    ++waiting_;
  }
  wake_.notify_one();
}

std::size_t Scheduler::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

void Scheduler::run(std::size_t worker) {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || waiting_ > 0; });
    if (stopping_) return;
    Channel* channel = queue_[first_];
    first_ = (first_ + 1) % queue_.size();
    --waiting_;
    ++busy_;
    lock.unlock();
    work_(worker, *channel);
    lock.lock();
    --busy_;
  }
}

}  // namespace gyrod::stream
