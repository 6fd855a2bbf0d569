#include "settings/schema_check.hpp"

#include <set>
#include <string>
#include <utility>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "settings/document.hpp"
#include "settings/schema.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using Path = std::vector<std::string>;

struct CompiledSchema {
  CompiledSchema() {
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schema()), rules);
  }
  valijson::Schema rules;
};

const valijson::Schema& compiled_schema() {
  static const CompiledSchema compiled;
  return compiled.rules;
}

bool is_list(const Path& path) {
  const json* key_schema = schema_at(path);
  return key_schema != nullptr && key_schema->contains("items");
}

/// {"<root>", "[denoise]", "[hop_samples]"} to {"denoise", "hop_samples"}. What is wrong inside a list is wrong with the list.
Path path_of(const std::vector<std::string>& context) {
  Path path;
  for (std::size_t i = 1; i < context.size() && !is_list(path); ++i)
    path.push_back(context[i].substr(1, context[i].size() - 2));
  return path;
}

std::string dotted(const Path& path) {
  std::string joined;
  for (const std::string& name : path) {
    if (&name != &path.front()) joined += '.';
    joined += name;
  }
  return joined;
}

const json& value_at(const json& document, const Path& path) {
  const json* value = &document;
  for (const std::string& name : path) value = &value->at(name);
  return *value;
}

/// The keys that a group may have: "one of a, b, c".
std::string keys_of(const json& group_schema) {
  std::string names;
  for (const auto& [name, value] : group_schema.at("properties").items()) {
    if (!name.starts_with('$')) names += (names.empty() ? "one of " : ", ") + name;
  }
  return names;
}

SettingsIssue unknown_key(const Path& group, const std::string& name, const json& value) {
  Path path = group;
  path.push_back(printable(name));
  const std::string key = dotted(path);
  const std::string nearest = nearest_key(*schema_at(group), name);
  std::string message = "unknown key " + key;
  const std::string expected = keys_of(*schema_at(group));
  message += nearest.empty() ? "; expected " + expected : "; did you mean " + nearest + "?";
  return {.key = key, .value = shortened(value), .expected = expected, .message = std::move(message)};
}

SettingsIssue wrong_value(const Path& path, const json& value) {
  const std::string key = dotted(path);
  const std::string words = expectation(*schema_at(path));
  const std::string subject = path.empty() ? "the whole file" : key;
  return {.key = key,
          .value = shortened(value),
          .expected = words,
          .message = subject + " is " + shortened(value) + "; expected " + words};
}

/// A place that the validator does not accept: a wrong value, or a group that holds unknown keys. A group
/// that is refused only for what one of its keys holds adds nothing: that key is a place of its own.
void explain(const json& document, const Path& path, std::vector<SettingsIssue>& issues) {
  const json& value = value_at(document, path);
  const json& expected = *schema_at(path);
  if (!expected.contains("properties") || !value.is_object()) {
    issues.push_back(wrong_value(path, value));
    return;
  }
  for (const auto& [name, member] : value.items()) {
    if (!expected["properties"].contains(name)) issues.push_back(unknown_key(path, name, member));
  }
}

}  // namespace

std::vector<SettingsIssue> check_against_schema(const json& document) {
  valijson::ValidationResults results;
  valijson::Validator validator;
  if (validator.validate(compiled_schema(), valijson::adapters::NlohmannJsonAdapter(document), &results))
    return {};
  std::set<Path> places;
  for (const auto& error : results) places.insert(path_of(error.context));
  std::vector<SettingsIssue> issues;
  for (const Path& place : places) explain(document, place, issues);
  return issues;
}

}  // namespace gyrod::settings
