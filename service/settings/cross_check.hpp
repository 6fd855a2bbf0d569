/// Checks that concern more than one key, and what a schema cannot say.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/issue.hpp"
#include "settings/settings.hpp"

namespace gyrod::settings {

/// Adds an issue for every rule that the settings break. A rule about a key that has an issue already is left
/// out: its value is not known.
/// @param document  what was given, to tell a given value from a default
/// @param directory what the paths in bus.network and noise are relative to
void cross_check(const Settings& settings, const nlohmann::json& document,
                 const std::filesystem::path& directory, std::vector<SettingsIssue>& issues);

/// Whether an issue concerns this key or a group that it is in.
[[nodiscard]] bool concerned(const std::vector<SettingsIssue>& issues, std::string_view key);

/// The value of a key, or nullptr if the document does not give it.
[[nodiscard]] const nlohmann::json* given_value(const nlohmann::json& document, std::string_view key);

/// A path of the configuration made absolute; empty stays empty.
[[nodiscard]] std::filesystem::path resolved(const std::string& path, const std::filesystem::path& directory);

/// The Cyclone DDS XML file that bus.network names, empty for "loopback" and "default".
[[nodiscard]] std::filesystem::path network_file(const BusSettings& bus,
                                                 const std::filesystem::path& directory);

}  // namespace gyrod::settings
