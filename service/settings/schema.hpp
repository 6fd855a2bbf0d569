/// The embedded config/gyrod.schema.json (JSON Schema draft 7), and its content in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace gyrod::settings {

/// The text of config/gyrod.schema.json as it was at build time.
[[nodiscard]] std::string_view schema_text() noexcept;

/// The same, parsed once. Thread-safe.
[[nodiscard]] const nlohmann::json& schema();

/// The schema of one key or group.
/// @param path names from the root down, e.g. {"denoise", "hop_samples"}; empty means the root
/// @return nullptr if there is no such key
[[nodiscard]] const nlohmann::json* schema_at(const std::vector<std::string>& path);

/// What a key's schema asks for, in words: "an integer from 1 to 32768 (samples)", "\"mirror\" or
/// \"linear\"".
[[nodiscard]] std::string expectation(const nlohmann::json& key_schema);

/// The known key of this group nearest to `name` by edit distance, or one that `name` begins (a forgotten
/// unit).
/// @return empty if none is near
[[nodiscard]] std::string nearest_key(const nlohmann::json& group_schema, std::string_view name);

}  // namespace gyrod::settings
