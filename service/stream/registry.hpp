/// The channels of an engine, by sensor id.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <shared_mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "stream/channel.hpp"

namespace gyrod::stream {

/// True for an id of 1..64 printable ASCII characters: what fits the wire, a metric label and a log line.
[[nodiscard]] bool is_valid_sensor_id(std::string_view sensor) noexcept;

/// Opens channels up to a limit and finds them again. One thread opens; any thread may look. Channels stay
/// for the life of the registry, so references to them stay valid.
class Registry {
 public:
  explicit Registry(std::size_t max_channels) : max_channels_(max_channels) {}

  [[nodiscard]] Channel* find(std::string_view sensor) const;
  [[nodiscard]] bool full() const;
  /// @throws std::bad_alloc, and is then as before
  Channel& open(std::unique_ptr<Channel> channel);
  [[nodiscard]] std::size_t size() const;

  /// Calls visit(Channel&) for up to `limit` channels in the order of opening.
  template <typename Visit>
  void for_each(std::size_t limit, const Visit& visit) const {
    const std::shared_lock lock(mutex_);
    for (std::size_t i = 0; i < channels_.size() && i < limit; ++i) visit(*channels_[i]);
  }

 private:
  std::size_t max_channels_;
  mutable std::shared_mutex mutex_;
  std::vector<std::unique_ptr<Channel>> channels_;
  std::unordered_map<std::string_view, Channel*> by_sensor_;  ///< keys live in the channels
};

}  // namespace gyrod::stream
