#include "settings/unused_keys.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string_view>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "settings/binding.hpp"
#include "settings/enum_names.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> kOfPaper = {"denoise.scheme", "denoise.screening", "denoise.sifts",
                                                      "denoise.boundary", "denoise.max_ar_order"};
constexpr std::array<std::string_view, 3> kOfJoint = {"denoise.max_signal_hz", "bus.topics.realtime",
                                                      "bus.topics.realtime_batch"};

/// Every key's value as the configuration would write it.
std::map<std::string, json, std::less<>> values(Settings settings) {
  std::map<std::string, json, std::less<>> all;
  for_each_key(settings, [&all](std::string_view key, const auto& member) {
    if constexpr (std::is_enum_v<std::decay_t<decltype(member)>>) {
      all.emplace(key, name_of(member));
    } else {
      all.emplace(key, member);
    }
  });
  return all;
}

}  // namespace

std::vector<std::string> unused_keys(const Settings& settings) {
  const auto given = values(settings);
  const auto defaults = values({});
  const bool is_joint = settings.denoise.method == Method::kJoint;
  std::vector<std::string> lines;
  const auto note = [&](std::string_view key) {
    const json& value = given.find(key)->second;
    if (value == defaults.find(key)->second) return;
    lines.push_back(std::string(key) + " is " + value.dump() + ", which is for denoise.method \"" +
                    (is_joint ? "paper" : "joint") + "\"; it is \"" + (is_joint ? "joint" : "paper") + "\"");
  };
  if (is_joint) {
    std::ranges::for_each(kOfPaper, note);
  } else {
    std::ranges::for_each(kOfJoint, note);
  }
  return lines;
}

}  // namespace gyrod::settings
