/// Looking things up in a configuration: keys, issues, paths.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/issue.hpp"
#include "settings/settings.hpp"

namespace gyrod::settings {

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
