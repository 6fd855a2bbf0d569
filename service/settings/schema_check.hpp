/// Checks a configuration against the embedded schema.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "settings/issue.hpp"

namespace gyrod::settings {

/// @return one issue for each wrong value and each unknown key; empty if and only if the schema accepts the
/// document
[[nodiscard]] std::vector<SettingsIssue> check_against_schema(const nlohmann::json& document);

}  // namespace gyrod::settings
