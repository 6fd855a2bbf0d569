#include "settings/lookup.hpp"

#include <algorithm>

namespace gyrod::settings {

using nlohmann::json;
namespace fs = std::filesystem;

bool concerned(const std::vector<SettingsIssue>& issues, std::string_view key) {
  return std::any_of(issues.begin(), issues.end(), [key](const SettingsIssue& issue) {
    return issue.key.empty() || key == issue.key || key.starts_with(issue.key + ".");
  });
}

const json* given_value(const json& document, std::string_view key) {
  const json* value = &document;
  while (!key.empty()) {
    const std::string_view name = key.substr(0, key.find('.'));
    key.remove_prefix(std::min(key.size(), name.size() + 1));
    const auto member = value->find(std::string(name));
    if (member == value->end()) return nullptr;
    value = &*member;
  }
  return value;
}

fs::path resolved(const std::string& path, const fs::path& directory) {
  return path.empty() ? fs::path() : fs::absolute(directory / path).lexically_normal();
}

fs::path network_file(const BusSettings& bus, const fs::path& directory) {
  if (bus.network == "loopback" || bus.network == "default") return {};
  return resolved(bus.network, directory);
}

}  // namespace gyrod::settings
