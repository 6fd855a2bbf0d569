/// Which sensors are alive on which topic. Internal to bus/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gyrod::bus {

/// A sensor may come by several sources, which are the readers of the topics, and has ended when none of them shows it alive. Collects what
/// the readers show; take_ending() then lists the sensors to look at. Allocates for a new sensor and for one that ends only.
class SensorStates {
 public:
  static constexpr std::size_t kMaxSources = 4;

  struct Ending {
    std::string sensor;
    std::uint64_t writer;  ///< DDS's handle of the last one that it had there
  };

  /// What a reader showed last of the sensor. @pre source < kMaxSources
  void show(std::string_view sensor, std::size_t source, bool alive, std::uint64_t writer) {
    auto found = states_.find(sensor);
    if (found == states_.end()) found = states_.emplace(sensor, State{}).first;
    found->second.alive[source] = alive;
    if (alive) {
      found->second.newest = source;
    } else if (ending_.empty() || ending_.back().sensor != sensor) {
      // Every message of an ended sensor shows it as such, and they come one after the other.
      ending_.push_back({std::string(sensor), writer});
    }
  }

  [[nodiscard]] bool knows(std::string_view sensor) const { return states_.contains(sensor); }

  /// Whether the sensor is alive there, and its newest message was. @pre source < kMaxSources
  [[nodiscard]] bool sends_by(std::string_view sensor, std::size_t source) const {
    const auto found = states_.find(sensor);
    return found != states_.end() && found->second.newest == source && found->second.alive[source];
  }

  /// The sensors that were shown as not alive since the last call, some possibly several times.
  [[nodiscard]] std::vector<Ending> take_ending() { return std::exchange(ending_, {}); }

  /// Forgets the sensor if no source shows it alive. @return true if it was known and is forgotten now
  bool forget_if_ended(std::string_view sensor) {
    const auto found = states_.find(sensor);
    if (found == states_.end() || found->second.alive != Alive{}) return false;
    states_.erase(found);
    return true;
  }

 private:
  using Alive = std::array<bool, kMaxSources>;
  struct State {
    Alive alive{};
    std::size_t newest = 0;
  };

  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const noexcept {
      return std::hash<std::string_view>{}(text);
    }
  };

  std::unordered_map<std::string, State, Hash, std::equal_to<>> states_;
  std::vector<Ending> ending_;
};

}  // namespace gyrod::bus
