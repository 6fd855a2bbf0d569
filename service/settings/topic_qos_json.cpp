#include "settings/topic_qos_json.hpp"

#include <algorithm>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "settings/enum_names.hpp"

namespace gyrod::settings {
namespace {

/// visit(key, member) for all that may be left out.
template <class Qos, class Visit>
void for_each_choice(Qos& qos, const Visit& visit) {
  visit("reliability", qos.reliability);
  visit("history_depth", qos.history_depth);
  visit("deadline_s", qos.deadline_s);
  visit("liveliness", qos.liveliness);
  visit("liveliness_lease_s", qos.liveliness_lease_s);
  visit("partitions", qos.partitions);
}

}  // namespace

void from_json(const nlohmann::json& json, TopicQosSettings& qos) {
  qos.topic = json.at("topic").get<std::string>();
  for_each_choice(qos, [&json]<class T>(const char* key, std::optional<T>& member) {
    const auto found = json.find(key);
    if (found == json.end()) return;
    if constexpr (std::is_enum_v<T>) {
      const auto names = names_of(T{});
      member = static_cast<T>(std::ranges::find(names, found->get<std::string>()) - names.begin());
    } else {
      member = found->get<T>();
    }
  });
}

void to_json(nlohmann::json& json, const TopicQosSettings& qos) {
  json = {{"topic", qos.topic}};
  for_each_choice(qos, [&json]<class T>(const char* key, const std::optional<T>& member) {
    if (!member) return;
    if constexpr (std::is_enum_v<T>) {
      json[key] = name_of(*member);
    } else {
      json[key] = *member;
    }
  });
}

}  // namespace gyrod::settings
