#include "settings/load.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <type_traits>
#include <utility>

#include "settings/binding.hpp"
#include "settings/cross_check.hpp"
#include "settings/document.hpp"
#include "settings/enum_names.hpp"
#include "settings/schema_check.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Far above any configuration; a wrong file is refused before it is read.
constexpr std::uintmax_t kMaxFileBytes = 1U << 20U;

/// Takes the given value of one key, of which the schema has approved.
template <class T>
void take(const json& value, T& member) {
  if constexpr (std::is_enum_v<T>) {
    const auto names = names_of(member);
    member = static_cast<T>(std::find(names.begin(), names.end(), value.get<std::string>()) - names.begin());
  } else {
    member = value.get<T>();
  }
}

SettingsIssue file_issue(std::string message) {
  return {.key = "", .value = "", .expected = "a readable JSON file", .message = std::move(message)};
}

/// @return why the file cannot be a configuration, empty if it can
std::string refusal(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return "no such file";
  if (error) return "cannot be read: " + error.message();
  if (fs::is_directory(status)) return "is a directory, not a file";
  if (!fs::is_regular_file(status)) return "is not a regular file";
  if (fs::file_size(file, error) > kMaxFileBytes) return "is larger than 1 MiB";
  return {};
}

Outcome read_file(const fs::path& file) {
  Outcome outcome;
  if (const std::string reason = refusal(file); !reason.empty()) {
    outcome.issues.push_back(file_issue(reason));
    return outcome;
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    outcome.issues.push_back(file_issue("cannot be read: " + std::generic_category().message(errno)));
    return outcome;
  }
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return read_settings(text, file.parent_path());
}

/// Into the order of the text; what the text does not give (a default that no longer fits) comes last.
void sort_by_position(const Document& document, std::vector<SettingsIssue>& issues) {
  const auto position = [&document](const SettingsIssue& issue) {
    const auto found = document.position.find(issue.key);
    return found == document.position.end() ? document.position.size() : found->second;
  };
  std::ranges::stable_sort(issues, {}, position);
}

std::string heading(const fs::path& file, const std::vector<SettingsIssue>& issues) {
  std::string text = file.string() + ": ";
  text += issues.size() == 1 ? "1 error" : std::to_string(issues.size()) + " errors";
  for (const SettingsIssue& issue : issues) text += "\n  " + issue.message;
  return text;
}

}  // namespace

SettingsError::SettingsError(const fs::path& file, std::vector<SettingsIssue> issues)
    : std::runtime_error(heading(file, issues)), issues_(std::move(issues)) {}

Outcome read_settings(std::string_view text, const fs::path& directory) {
  Document document = parse_document(text);
  Outcome outcome{.settings = {}, .issues = std::move(document.issues)};
  if (!document.parsed) return outcome;

  std::vector<SettingsIssue> wrong = check_against_schema(document.root);
  std::move(wrong.begin(), wrong.end(), std::back_inserter(outcome.issues));
  if (!document.root.is_object()) return outcome;

  for_each_key(outcome.settings, [&](std::string_view key, auto& member) {
    const json* value = concerned(outcome.issues, key) ? nullptr : given_value(document.root, key);
    if (value != nullptr) take(*value, member);
  });
  cross_check(outcome.settings, document.root, directory, outcome.issues);
  sort_by_position(document, outcome.issues);
  const fs::path network = network_file(outcome.settings.bus, directory);
  if (!network.empty()) outcome.settings.bus.network = network.string();
  return outcome;
}

std::vector<SettingsIssue> validate(const fs::path& file) { return read_file(file).issues; }

Settings load_settings(const fs::path& file) {
  Outcome outcome = read_file(file);
  if (!outcome.issues.empty()) throw SettingsError(file, std::move(outcome.issues));
  return outcome.settings;
}

}  // namespace gyrod::settings
