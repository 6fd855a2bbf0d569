/// Rules for the quality of service that the schema cannot state.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/settings.hpp"

namespace gyrod::settings {

struct Mistake {
  std::string key;  ///< e.g. "bus.topic_qos[2]"
  nlohmann::json value;
  std::string expected;
  std::vector<std::string> others = {};  ///< keys besides `key` that the rule depends on
};

/// In the order of the configuration; none where all is well.
[[nodiscard]] std::vector<Mistake> qos_mistakes(const BusSettings& bus);

}  // namespace gyrod::settings
