/// Rules for single topics' quality of service that the schema cannot state.
#pragma once

#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace gyrod::settings {

struct Mistake {
  std::string key;  ///< e.g. "bus.topic_qos[2]"
  std::string value;
  std::string expected;
};

/// In the order of the configuration; none where all is well.
[[nodiscard]] std::vector<Mistake> mistakes_of_topic_qos(const BusSettings& bus);

}  // namespace gyrod::settings
