#include "monitor/stream_hub.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <utility>

#include "monitor/background.hpp"

namespace gyrod::monitor {

void StreamHub::start() {
  thread_ = std::thread([this] { serve(); });
}

void StreamHub::stop() noexcept {
  stopping_ = true;
  wake_.raise();
  if (!thread_.joinable()) return;
  thread_.join();
  const std::scoped_lock lock(mutex_);
  for (std::vector<EventStream>* streams : {&streams_, &new_ones_}) {
    for (EventStream& stream : *streams) stream.finish(options_);
    streams->clear();
  }
}

StreamHub::Place StreamHub::reserve() {
  std::size_t taken = taken_;
  do {
    if (taken >= options_.max_streams) return nullptr;
  } while (!taken_.compare_exchange_weak(taken, taken + 1));
  return {&taken_, [](std::atomic<std::size_t>* count) { --*count; }};
}

void StreamHub::add(EventStream stream) {
  const std::scoped_lock lock(mutex_);
  if (stopping_) return;
  new_ones_.push_back(std::move(stream));
  wake_.raise();
}

void StreamHub::serve() noexcept {
  run_in_background();
  while (!stopping_) {
    try {
      wait();
      take_new_ones();
    } catch (const std::exception&) {
      streams_.clear();  // out of memory: clients of event streams come back by themselves
    }
    step();
  }
}

void StreamHub::wait() {
  std::vector<pollfd> descriptors{{wake_.descriptor(), POLLIN, 0}};
  Deadline next = Deadline::max();
  for (const EventStream& stream : streams_) {
    descriptors.push_back(stream.waits_for());
    next = std::min(next, stream.next());
  }
  poll_until(descriptors, next);
}

void StreamHub::take_new_ones() {
  wake_.clear();
  const std::scoped_lock lock(mutex_);
  streams_.insert(streams_.end(), std::move_iterator(new_ones_.begin()), std::move_iterator(new_ones_.end()));
  new_ones_.clear();
}

void StreamHub::step() noexcept {
  std::erase_if(streams_, [this](EventStream& stream) {
    try {
      return !stream.step(options_, std::chrono::steady_clock::now());
    } catch (const std::exception&) {
      return true;  // the source has failed; its client may ask again
    }
  });
}

}  // namespace gyrod::monitor
