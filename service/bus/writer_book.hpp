/// The writers of some types in a domain, as discovery tells. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "bus/domain.hpp"
#include "bus/entity.hpp"
#include "bus/qos_profile.hpp"

namespace gyrod::bus {

/// Knows of each writer whether it is best effort, and tells which are new. A reader that takes from writers of one kind asks it by the
/// handle that comes with each message. Holds what DDS itself holds of writers of those types, and the last that have gone. One thread.
class WriterBook {
 public:
  /// @param types names of types on the wire; writers of others are left out @throws BusError
  WriterBook(const Domain& domain, std::vector<std::string_view> types);

  struct Writer {
    std::string topic;
    Reliability reliability;
  };

  /// Holds while there is news: for a waitset.
  [[nodiscard]] dds_entity_t condition() const noexcept { return news_condition_.get(); }

  /// The writers that have appeared since the last call.
  [[nodiscard]] std::vector<Writer> take_news();

  /// One time that a writer was discovered. One that was out of sight and is back keeps its id, whatever its handle is now.
  struct Sighting {
    std::array<std::uint8_t, 16> writer{};  ///< its id in the domain (GUID)
    std::uint64_t number = 0;               ///< counts all sightings
    /// Whether it is the same writer, discovered anew.
    [[nodiscard]] bool is_return_of(const Sighting& before) const noexcept {
      return writer == before.writer && number != before.number;
    }
  };

  /// The last of the writer of a message. @return nothing for a handle that is of no writer of these types
  [[nodiscard]] std::optional<Sighting> last_sighting(dds_instance_handle_t writer);

  /// Discovery comes before a writer's messages, so that every handle of a message is known here. @return false also for a handle that is
  /// of no writer of these types
  [[nodiscard]] bool is_best_effort(dds_instance_handle_t writer);

 private:
  struct Entry {
    bool best_effort = false;
    Sighting sighting;
  };

  void look();

  std::vector<std::string_view> types_;
  Entity publications_;
  Entity news_condition_;
  std::unordered_map<dds_instance_handle_t, Entry> writers_;
  std::uint64_t sightings_ = 0;
  std::deque<dds_instance_handle_t> gone_;  ///< still in writers_: their messages may wait in a cache
  std::vector<Writer> news_;
};

/// The reliability that a discovered writer or reader shows.
[[nodiscard]] Reliability reliability_of(const dds_qos_t* qos) noexcept;

}  // namespace gyrod::bus
