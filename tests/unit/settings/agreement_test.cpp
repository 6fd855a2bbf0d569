// The schema is the one place that states every key; here the structs, the engine's documented bounds, the
// reference configuration and the manual are held to it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "settings/binding.hpp"
#include "settings/enum_names.hpp"
#include "settings/load.hpp"
#include "settings/schema.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;

std::filesystem::path source_dir() {
  const char* dir = std::getenv("GYROD_SOURCE_DIR");
  return dir == nullptr ? "." : dir;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Every key of the schema with its own schema, by dotted name; groups are left out, and "$schema" is not
/// ours.
void collect_keys(const json& group, const std::string& prefix, std::map<std::string, json>& keys) {
  for (const auto& [name, node] : group.at("properties").items()) {
    if (node.contains("properties")) {
      collect_keys(node, prefix + name + ".", keys);
    } else if (name != "$schema") {
      keys[prefix + name] = node;
    }
  }
}

std::map<std::string, json> schema_keys() {
  std::map<std::string, json> keys;
  collect_keys(schema(), "", keys);
  return keys;
}

/// The settings as the JSON values that would give them.
std::map<std::string, json> values_of(Settings settings) {
  std::map<std::string, json> values;
  for_each_key(settings, [&](const std::string& key, auto& member) {
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(member)>>) {
      values[key] = name_of(member);
    } else {
      values[key] = member;
    }
  });
  return values;
}

TEST(SettingsAgreement, EveryKeyOfTheSchemaIsAMemberWithTheSameDefaultAndTheOtherWayRound) {
  std::map<std::string, json> defaults;
  for (const auto& [key, node] : schema_keys()) defaults[key] = node.at("default");
  EXPECT_EQ(values_of(Settings{}), defaults);
}

TEST(SettingsAgreement, TheReferenceConfigurationGivesEveryKeyItsDefault) {
  const std::filesystem::path file = source_dir() / "config/gyrod.json";
  EXPECT_EQ(values_of(load_settings(file)), values_of(Settings{}));
  json given = json::parse(text_of(file), nullptr, true, true).flatten();
  std::map<std::string, json> defaults;
  for (const auto& [key, node] : schema_keys()) defaults[key] = node.at("default");
  EXPECT_EQ(given.size(), defaults.size() + 1) << "every key, and $schema";
}

TEST(SettingsAgreement, EveryKeyIsAcceptedAtItsBoundsAndRefusedBeyondThem) {
  for (const auto& [key, node] : schema_keys()) {
    if (!node.contains("minimum")) continue;
    const auto issues_with = [&key](const json& value) {
      std::string pointer = "/" + key;
      for (char& c : pointer) c = c == '.' ? '/' : c;
      json document;
      document[json::json_pointer(pointer)] = value;
      std::size_t count = 0;
      for (const SettingsIssue& issue : read_settings(document.dump(), ".").issues) {
        count += issue.message.find("expected an integer") != std::string::npos ||
                 issue.message.find("expected a number") != std::string::npos;
      }
      return count;
    };
    EXPECT_EQ(issues_with(node["minimum"]), 0U) << key;
    EXPECT_EQ(issues_with(node["maximum"]), 0U) << key;
    EXPECT_EQ(issues_with(node["minimum"].get<double>() - 1.0), 1U) << key;
    EXPECT_EQ(issues_with(node["maximum"].get<double>() + 1.0), 1U) << key;
  }
}

TEST(SettingsAgreement, TheBoundsAreThoseDocumentedAtTheEngine) {
  // From the comments in stream/engine.hpp; what depends on the window has its value at the largest window,
  // 65536.
  const std::map<std::string, std::pair<double, double>> documented = {
      {"denoise.window_samples", {64, 65536}}, {"denoise.hop_samples", {1, 32768}},
      {"limits.max_hop_samples", {1, 32768}},  {"denoise.lag_samples", {0, 16384}},
      {"limits.max_queued_windows", {1, 64}},  {"limits.max_channels", {1, 100000}},
      {"limits.max_delay_s", {0.01, 3600}},    {"limits.max_bridged_samples", {0, 16384}},
      {"limits.silent_after_s", {0, 86400}},   {"limits.forget_after_s", {0, 31536000}}};
  const auto keys = schema_keys();
  for (const auto& [key, bounds] : documented) {
    EXPECT_EQ(keys.at(key).at("minimum").get<double>(), bounds.first) << key;
    EXPECT_EQ(keys.at(key).at("maximum").get<double>(), bounds.second) << key;
  }
}

TEST(SettingsAgreement, EnumeratorsAreNamedInTheOrderOfTheSchema) {
  const auto keys = schema_keys();
  Settings settings;
  for_each_key(settings, [&](const std::string& key, auto& member) {
    if constexpr (std::is_enum_v<std::remove_reference_t<decltype(member)>>) {
      EXPECT_EQ(json(names_of(member)), keys.at(key).at("enum")) << key;
    }
  });
}

TEST(SettingsAgreement, EveryNameOfAnEnumerationIsTaken) {
  EXPECT_EQ(read_settings(R"({"bus": {"input": {"reliability": "best_effort"}}})", ".")
                .settings.bus.input.reliability,
            InputReliability::kBestEffort);
  EXPECT_EQ(read_settings(R"({"bus": {"ros2": {"input_liveliness": "manual_by_topic"}}})", ".")
                .settings.bus.ros2.input_qos.liveliness,
            Liveliness::kManualByTopic);
  EXPECT_EQ(read_settings(R"({"denoise": {"screening": "paper"}})", ".").settings.denoise.screening,
            Screening::kPaper);
  EXPECT_EQ(read_settings(R"({"denoise": {"boundary": "linear"}})", ".").settings.denoise.boundary,
            core::BoundaryRule::kLinear);
  EXPECT_EQ(read_settings(R"({"log": {"level": "error"}})", ".").settings.log_level, LogLevel::kError);
}

TEST(SettingsAgreement, AKeyWithAPhysicalUnitEndsInIt) {
  const std::map<std::string, std::string> suffixes = {
      {"samples", "_samples"}, {"s", "_s"}, {"Hz", "_hz"}, {"rad/s", "_radps"}};
  for (const auto& [key, node] : schema_keys()) {
    const auto suffix = suffixes.find(node.value("unit", ""));
    EXPECT_TRUE(suffix == suffixes.end() || key.ends_with(suffix->second)) << key;
  }
}

TEST(SettingsAgreement, EveryGroupRefusesUnknownKeys) {
  std::function<void(const json&, const std::string&)> check = [&](const json& node,
                                                                   const std::string& name) {
    if (!node.contains("properties")) return;
    EXPECT_EQ(node.value("additionalProperties", true), false) << name;
    for (const auto& [key, member] : node["properties"].items()) check(member, name + "/" + key);
  };
  check(schema(), "");
}

TEST(SettingsAgreement, TheManualHasARowForEveryKeyWithItsDefault) {
  const std::string manual = text_of(source_dir() / "docs/configuration.md");
  for (const auto& [key, node] : schema_keys()) {
    const std::size_t row = manual.find("| `" + key + "` |");
    ASSERT_NE(row, std::string::npos) << key;
    const std::string line = manual.substr(row, manual.find('\n', row) - row);
    EXPECT_NE(line.find("| `" + node.at("default").dump() + "` |"), std::string::npos) << line;
    if (!node.contains("minimum")) continue;
    const std::string range = node["minimum"].dump() + " to " + node["maximum"].dump();
    EXPECT_NE(line.find(range), std::string::npos) << line << " lacks " << range;
  }
}

}  // namespace
}  // namespace gyrod::settings
