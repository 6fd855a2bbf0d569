/// What is written to a topic, as discovery tells. Internal to bus/.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"

namespace gyrod::bus {

struct TopicFound {
  std::string type_name;  ///< e.g. "gyrod::DenoisedSample"
  Reliability reliability = Reliability::kReliable;
};

/// Waits until a writer of the topic is seen anywhere in the domain, and tells the first one's type and
/// reliability.
/// @return nothing if none was seen by then
/// @throws BusError if DDS refuses
[[nodiscard]] std::optional<TopicFound> find_topic(const Domain& domain, const std::string& topic,
                                                   std::chrono::milliseconds timeout);

}  // namespace gyrod::bus
