/// From settings back to the configuration that gives them.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "settings/settings.hpp"

namespace gyrod::settings {

/// The value of every key, by its dotted name.
[[nodiscard]] std::map<std::string, nlohmann::json, std::less<>> values_of(Settings settings);

/// A configuration file with every key, in the order of the reference configuration's groups. Paths are absolute; what the files hold is not
/// told. read_settings() makes the same settings of it.
[[nodiscard]] std::string text_of(const Settings& settings);

}  // namespace gyrod::settings
