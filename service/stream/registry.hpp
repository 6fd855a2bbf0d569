/// The channels of an engine, by sensor id.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "stream/channel.hpp"

namespace gyrod::stream {

/// True for an id of 1..64 printable ASCII characters: what fits the wire, a metric label and a log line.
[[nodiscard]] bool is_valid_sensor_id(std::string_view sensor) noexcept;

/// Opens channels up to a limit and finds them again. One thread opens and removes; any thread may look. A reference to a channel
/// is valid until that thread removes it, which it does only to one that no worker has or will have.
class Registry {
 public:
  explicit Registry(std::size_t max_channels) : max_channels_(max_channels) {}

  [[nodiscard]] Channel* find(std::string_view sensor) const;
  [[nodiscard]] bool full() const;
  /// @throws std::bad_alloc, and is then as before
  Channel& open(std::unique_ptr<Channel> channel);
  /// @return the channels that it holds for, taken out, in the order of opening
  template <typename Condition>
  [[nodiscard]] std::vector<std::unique_ptr<Channel>> remove_if(const Condition& condition);
  [[nodiscard]] std::size_t size() const;

  /// Calls visit(Channel&) for up to `limit` channels in the order of opening.
  template <typename Visit>
  void for_each(std::size_t limit, const Visit& visit) const {
    const std::shared_lock lock(mutex_);
    for (std::size_t i = 0; i < channels_.size() && i < limit; ++i) visit(*channels_[i]);
  }

  /// Calls visit(const Channel&) for the one at this place in the order of opening, while it cannot be removed.
  /// @return false where there is none
  template <typename Visit>
  bool look_at(std::size_t place, const Visit& visit) const {
    const std::shared_lock lock(mutex_);
    if (place >= channels_.size()) return false;
    visit(std::as_const(*channels_[place]));
    return true;
  }
  /// The same of a sensor's.
  template <typename Visit>
  void look_at(std::string_view sensor, const Visit& visit) const {
    const std::shared_lock lock(mutex_);
    if (const auto found = by_sensor_.find(sensor); found != by_sensor_.end())
      visit(std::as_const(*found->second));
  }

 private:
  std::size_t max_channels_;
  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::unordered_map<std::string_view, Channel*> by_sensor_;  ///< keys live in the channels
};

template <typename Condition>
std::vector<std::unique_ptr<Channel>> Registry::remove_if(const Condition& condition) {
  const std::unique_lock lock(mutex_);
  const auto holds = [&](const auto& channel) { return condition(*channel); };
  if (std::none_of(channels_.begin(), channels_.end(), holds)) return {};
  const auto first = std::stable_partition(channels_.begin(), channels_.end(), std::not_fn(holds));
  std::vector<std::unique_ptr<Channel>> removed(std::make_move_iterator(first),
                                                std::make_move_iterator(channels_.end()));
  for (const auto& channel : removed) by_sensor_.erase(channel->sensor());
  channels_.erase(first, channels_.end());
  return removed;
}

}  // namespace gyrod::stream
