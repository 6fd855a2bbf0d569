/// Reads the configuration file: JSON with comments, checked against the embedded config/gyrod.schema.json
/// and then across keys. Every error is found before one is reported, and no value is ever repaired in
/// silence.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "settings/issue.hpp"
#include "settings/settings.hpp"

namespace gyrod::settings {

/// what() is a heading that names the file, then one line an issue.
class SettingsError : public std::runtime_error {
 public:
  SettingsError(const std::filesystem::path& file, const std::vector<SettingsIssue>& issues);
};

struct Outcome {
  Settings settings;                  ///< valid only if there is no issue
  std::vector<SettingsIssue> issues;  ///< in the order of the text, defaults that do not fit last
};

/// Checks a configuration given as text. Never throws for what the text holds.
/// @param directory what relative paths inside it are relative to
[[nodiscard]] Outcome read_settings(std::string_view text, const std::filesystem::path& directory);

/// @throws SettingsError with all that is wrong
[[nodiscard]] Settings load_settings(const std::filesystem::path& file);

/// Whether the file itself gives the key, "denoise.screening" say, be it with its default.
/// @pre load_settings() takes the file
[[nodiscard]] bool gives(const std::filesystem::path& file, std::string_view key);

}  // namespace gyrod::settings
