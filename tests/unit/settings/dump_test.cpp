/// Settings written as a configuration, and read again.
#include "settings/dump.hpp"

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>

#include "settings/binding.hpp"
#include "settings/enum_names.hpp"
#include "settings/load.hpp"
#include "settings/schema.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using ::testing::IsEmpty;

/// Another value for every key, whether it makes sense or not.
Settings all_changed() {
  Settings settings;
  for_each_key(settings, [](std::string_view, auto& member) {
    using Member = std::remove_reference_t<decltype(member)>;
    if constexpr (std::is_enum_v<Member>) {
      const std::size_t count = names_of(member).size();
      member = static_cast<Member>((static_cast<std::size_t>(member) + 1) % count);
    } else if constexpr (std::is_same_v<Member, bool>) {
      member = !member;
    } else if constexpr (std::is_arithmetic_v<Member>) {
      member = static_cast<Member>(member + 1);
    } else if constexpr (std::is_same_v<Member, std::string>) {
      member += "x";
    } else {
      member.resize(member.size() + 1);
    }
  });
  return settings;
}

void expect_every_key(const json& group, const std::string& prefix, const json& dumped) {
  for (const auto& [name, node] : group.at("properties").items()) {
    if (name == "$schema") continue;
    ASSERT_TRUE(dumped.contains(name)) << prefix + name;
    if (node.contains("properties")) expect_every_key(node, prefix + name + ".", dumped.at(name));
  }
}

TEST(SettingsDump, HasEveryKeyOfTheSchema) {
  expect_every_key(schema(), "", json::parse(text_of(Settings{})));
}

TEST(SettingsDump, TheDefaultsAreReadAgainAsTheDefaults) {
  const Outcome outcome = read_settings(text_of(Settings{}), ".");
  EXPECT_THAT(outcome.issues, IsEmpty());
  EXPECT_EQ(values_of(outcome.settings), values_of(Settings{}));
}

TEST(SettingsDump, WhatIsSetIsReadAgain) {
  const std::string text = R"({"bus": {"domain": 7, "shard": "2/3", "topics": {"raw": "a/b"},
        "input": {"reliability": "best_effort", "partitions": ["car*", "\u00e9"]}, "output": {"takeover_s": 0.25},
        "topic_qos": [{"topic": "a/b", "reliability": "reliable"}],
        "ros2": {"denoised_suffix": "_quiet"}},
      "denoise": {"method": "paper", "scheme": "raw", "window_samples": 512, "max_signal_hz": 12.5},
      "limits": {"forget_after_s": 1234.5}, "health": {"noisy_ratio": 1.75}, "workers": 3,
      "monitor": {"enabled": false, "port": 1234}, "log": {"level": "debug"}})";
  const Outcome given = read_settings(text, "/");
  ASSERT_THAT(given.issues, IsEmpty());
  const Outcome again = read_settings(text_of(given.settings), "/elsewhere");
  EXPECT_THAT(again.issues, IsEmpty());
  EXPECT_EQ(values_of(again.settings), values_of(given.settings));
  EXPECT_NE(values_of(again.settings), values_of(Settings{}));
}

TEST(SettingsDump, EveryKeyShowsItsOwnValue) {
  const Settings settings = all_changed();
  const json dumped = json::parse(text_of(settings));
  const auto defaults = values_of({});
  for (const auto& [key, value] : values_of(settings)) {
    std::string pointer = "/" + key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    EXPECT_EQ(dumped.at(json::json_pointer(pointer)), value) << key;
    EXPECT_NE(value, defaults.at(key)) << key;
  }
}

}  // namespace
}  // namespace gyrod::settings
