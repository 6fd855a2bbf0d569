#include "settings/load.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

#include "settings/binding.hpp"
#include "settings/cross_check.hpp"
#include "settings/document.hpp"
#include "settings/enum_names.hpp"
#include "settings/schema_check.hpp"
#include "settings/text_file.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Far above any configuration; a wrong file is refused before it is read.
constexpr std::size_t kMaxFileMebibytes = 1;

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

/// How far the hop widens, where the text does not say: half of its window at the most, and no less than its hop.
void fit_widest_hop(const json& document, stream::EngineOptions& engine) {
  if (given_value(document, "limits.max_hop_samples") != nullptr) return;
  engine.max_hop_samples =
      std::max(engine.hop_samples, std::min(engine.max_hop_samples, engine.window_samples / 2));
}

SettingsIssue file_issue(std::string message) {
  return {.key = "", .value = "", .expected = "a readable JSON file", .message = std::move(message)};
}

Outcome read_file(const fs::path& file) {
  const TextFile read = read_text_file(file, kMaxFileMebibytes);
  if (read.trouble.empty()) return read_settings(read.text, file.parent_path());
  Outcome outcome;
  outcome.issues.push_back(file_issue(read.trouble));
  return outcome;
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

SettingsError::SettingsError(const fs::path& file, const std::vector<SettingsIssue>& issues)
    : std::runtime_error(heading(file, issues)) {}

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
  fit_widest_hop(document.root, outcome.settings.engine);
  cross_check(outcome.settings, document.root, directory, outcome.issues);
  sort_by_position(document, outcome.issues);
  const fs::path network = network_file(outcome.settings.bus, directory);
  if (!network.empty()) outcome.settings.bus.network = network.string();
  std::string& security_folder = outcome.settings.bus.security.folder;
  security_folder = resolved(security_folder, directory).string();
  NoiseSettings& noise = outcome.settings.noise;
  noise.calibrations = resolved(noise.calibrations, directory).string();
  noise.state_file = resolved(noise.state_file, directory).string();
  MonitorSettings& monitor = outcome.settings.monitor;
  for (std::string* file : {&monitor.tls.certificate_file, &monitor.tls.key_file, &monitor.auth.token_file,
                            &monitor.auth.users_file})
    *file = resolved(*file, directory).string();
  std::string& published = outcome.settings.restart.published_file;
  published = resolved(published, directory).string();
  return outcome;
}

Settings load_settings(const fs::path& file) {
  Outcome outcome = read_file(file);
  if (!outcome.issues.empty()) throw SettingsError(file, outcome.issues);
  return outcome.settings;
}

bool gives(const fs::path& file, std::string_view key) {
  const Document document = parse_document(read_text_file(file, kMaxFileMebibytes).text);
  return given_value(document.root, key) != nullptr;
}

}  // namespace gyrod::settings
