/// Which sensors are alive on which topic. Internal to bus/.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gyrod::bus {

/// A sensor may write to several topics and has ended when none of them shows it alive. Collects what the
/// readers show; ending() then lists the sensors to look at. Allocates for a new sensor and for one that ends
/// only.
class SensorStates {
 public:
  static constexpr std::size_t kMaxTopics = 2;

  /// What a reader showed last of the sensor on this topic. @pre topic < kMaxTopics
  void show(std::string_view sensor, std::size_t topic, bool alive) {
    auto found = alive_.find(sensor);
    if (found == alive_.end()) found = alive_.emplace(sensor, Alive{}).first;
    found->second[topic] = alive;
    // Every message of an ended sensor shows it as such, and they come one after the other.
    if (!alive && (ending_.empty() || ending_.back() != sensor)) ending_.emplace_back(sensor);
  }

  [[nodiscard]] bool knows(std::string_view sensor) const { return alive_.contains(sensor); }

  /// The sensors that were shown as not alive since the last call, some possibly several times.
  [[nodiscard]] std::vector<std::string> take_ending() { return std::exchange(ending_, {}); }

  /// Forgets the sensor if no topic shows it alive. @return true if it was known and is forgotten now
  bool forget_if_ended(std::string_view sensor) {
    const auto found = alive_.find(sensor);
    if (found == alive_.end() || found->second != Alive{}) return false;
    alive_.erase(found);
    return true;
  }

 private:
  using Alive = std::array<bool, kMaxTopics>;

  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const noexcept {
      return std::hash<std::string_view>{}(text);
    }
  };

  std::unordered_map<std::string, Alive, Hash, std::equal_to<>> alive_;
  std::vector<std::string> ending_;
};

}  // namespace gyrod::bus
