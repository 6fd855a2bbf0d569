/// What is written to a topic, as discovery tells. Internal to bus/.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "bus/domain.hpp"

namespace gyrod::bus {

struct TopicFound {
  std::string type_name;  ///< e.g. "gyrod::DenoisedSample"
  std::vector<std::string> partitions = {};
  bool exclusive = false;  ///< ownership
};

/// Waits until a writer of the topic is seen anywhere in the domain, and tells the first one's type, partitions and ownership.
/// @return nothing if none was seen by then
/// @throws BusError if DDS refuses
[[nodiscard]] std::optional<TopicFound> find_topic(const Domain& domain, const std::string& topic,
                                                   std::chrono::milliseconds timeout);

}  // namespace gyrod::bus
