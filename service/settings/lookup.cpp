#include "settings/lookup.hpp"

#include <algorithm>

namespace gyrod::settings {

bool concerned(const std::vector<SettingsIssue>& issues, std::string_view key) {
  return std::any_of(issues.begin(), issues.end(), [key](const SettingsIssue& issue) {
    return issue.key.empty() || key == issue.key || key.starts_with(issue.key + ".");
  });
}

const nlohmann::json* given_value(const nlohmann::json& document, std::string_view key) {
  const nlohmann::json* value = &document;
  while (!key.empty()) {
    const std::string_view name = key.substr(0, key.find('.'));
    key.remove_prefix(std::min(key.size(), name.size() + 1));
    const auto member = value->find(std::string(name));
    if (member == value->end()) return nullptr;
    value = &*member;
  }
  return value;
}

std::filesystem::path resolved(const std::string& path, const std::filesystem::path& directory) {
  return path.empty() ? std::filesystem::path()
                      : std::filesystem::absolute(directory / path).lexically_normal();
}

std::filesystem::path network_file(const BusSettings& bus, const std::filesystem::path& directory) {
  if (bus.network == "loopback" || bus.network == "default") return {};
  return resolved(bus.network, directory);
}

}  // namespace gyrod::settings
