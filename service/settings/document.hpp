/// JSON text to a JSON value, with what the JSON library lets pass made an error: repeated keys and deep
/// nesting.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <nlohmann/json.hpp>

#include "settings/issue.hpp"

namespace gyrod::settings {

struct Document {
  /// Complete only if nothing in `issues` concerns the syntax; then `parsed` is true.
  nlohmann::json root;
  bool parsed = false;
  std::vector<SettingsIssue> issues;
  /// Of each key, dotted as SettingsIssue::key: how many others came before it in the text.
  std::unordered_map<std::string, std::size_t> position;
};

/// Parses JSON with // and /* */ comments; a UTF-8 byte order mark is skipped. A syntax error is reported
/// with line, column and what was expected, and ends the parsing; repeated keys are reported one by one.
/// Never throws for what the text holds.
[[nodiscard]] Document parse_document(std::string_view text);

/// A JSON value on one line, cut after 80 bytes.
[[nodiscard]] std::string shortened(const nlohmann::json& value);

/// Text from outside made fit for a terminal: control and non-ASCII bytes replaced, the middle of a long one
/// left out.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace gyrod::settings
