/// Checks that concern more than one key, and what a schema cannot say.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/issue.hpp"
#include "settings/lookup.hpp"
#include "settings/settings.hpp"

namespace gyrod::settings {

/// Adds an issue for every rule that the settings break. A rule about a key that has an issue already is left
/// out: its value is not known.
/// @param document  what was given, to tell a given value from a default
/// @param directory what the paths in bus.network and noise are relative to
void cross_check(const Settings& settings, const nlohmann::json& document,
                 const std::filesystem::path& directory, std::vector<SettingsIssue>& issues);

}  // namespace gyrod::settings
