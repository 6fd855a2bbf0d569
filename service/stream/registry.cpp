#include "stream/registry.hpp"

#include <algorithm>
#include <mutex>
#include <utility>

namespace gyrod::stream {

bool is_valid_sensor_id(std::string_view sensor) noexcept {
  constexpr std::size_t kLongest = 64;
  return !sensor.empty() && sensor.size() <= kLongest &&
         std::all_of(sensor.begin(), sensor.end(), [](char c) { return c > ' ' && c <= '~'; });
}

Channel* Registry::find(std::string_view sensor) const {
  const std::shared_lock lock(mutex_);
  const auto found = by_sensor_.find(sensor);
  return found == by_sensor_.end() ? nullptr : found->second;
}

bool Registry::full() const { return size() >= max_channels_; }

Channel& Registry::open(std::unique_ptr<Channel> channel) {
  const std::unique_lock lock(mutex_);
  Channel& opened = *channels_.emplace_back(std::move(channel));
  try {
    by_sensor_.emplace(opened.sensor(), &opened);
  } catch (...) {
    channels_.pop_back();  // not half open: counted against the limit, and found by nobody
    throw;
  }
  return opened;
}

std::size_t Registry::size() const {
  const std::shared_lock lock(mutex_);
  return channels_.size();
}

}  // namespace gyrod::stream
