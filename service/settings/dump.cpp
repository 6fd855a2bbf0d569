#include "settings/dump.hpp"

#include <string_view>
#include <type_traits>

#include "settings/binding.hpp"
#include "settings/enum_names.hpp"

namespace gyrod::settings {
namespace {

template <class Visit>
void for_each_value(Settings& settings, const Visit& visit) {
  for_each_key(settings, [&visit](std::string_view key, const auto& member) {
    if constexpr (std::is_enum_v<std::decay_t<decltype(member)>>) {
      visit(key, name_of(member));
    } else {
      visit(key, member);
    }
  });
}

}  // namespace

std::map<std::string, nlohmann::json, std::less<>> values_of(Settings settings) {
  std::map<std::string, nlohmann::json, std::less<>> all;
  for_each_value(settings, [&all](std::string_view key, const auto& value) { all.emplace(key, value); });
  return all;
}

std::string text_of(const Settings& settings) {
  Settings given = settings;
  nlohmann::ordered_json root;
  for_each_value(given, [&root](std::string_view key, const auto& value) {
    nlohmann::ordered_json* group = &root;
    for (std::size_t dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.')) {
      group = &(*group)[std::string(key.substr(0, dot))];
      key.remove_prefix(dot + 1);
    }
    (*group)[std::string(key)] = nlohmann::json(value);
  });
  return root.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace gyrod::settings
