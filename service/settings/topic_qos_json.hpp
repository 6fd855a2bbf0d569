/// Single topics' quality of service as the configuration writes it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "settings/settings.hpp"

namespace gyrod::settings {

/// Of what the schema has approved.
void from_json(const nlohmann::json& json, TopicQosSettings& qos);
/// What is not said has no key.
void to_json(nlohmann::json& json, const TopicQosSettings& qos);

}  // namespace gyrod::settings
