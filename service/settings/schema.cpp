#include "settings/schema.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace gyrod::settings {
namespace {

using nlohmann::json;

/// "a", "a or b", "a, b or c".
std::string alternatives(const json& values) {
  std::string words;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) words += i + 1 == values.size() ? " or " : ", ";
    words += values[i].dump();
  }
  return words;
}

/// " from 1 to 32768 (samples)".
std::string range(const json& key_schema) {
  std::string words = " from " + key_schema.at("minimum").dump() + " to " + key_schema.at("maximum").dump();
  if (key_schema.contains("unit")) words += " (" + key_schema["unit"].get<std::string>() + ")";
  return words;
}

std::string text_length(const json& key_schema) {
  if (!key_schema.contains("maxLength")) return "a text";
  return "a text of " + key_schema.at("minLength").dump() + " to " + key_schema.at("maxLength").dump() +
         " characters";
}

/// Levenshtein distance: insertions, deletions and substitutions from one to the other.
std::size_t edit_distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (const char letter : from) {
    std::size_t diagonal = row[0]++;
    for (std::size_t i = 0; i < to.size(); ++i) {
      const std::size_t substituted = diagonal + (letter == to[i] ? 0 : 1);
      diagonal = row[i + 1];
      row[i + 1] = std::min({substituted, row[i] + 1, row[i + 1] + 1});
    }
  }
  return row.back();
}

/// How many wrong letters still look like a slip: a third of the word.
std::size_t tolerated_slips(std::string_view known) { return std::max<std::size_t>(1, known.size() / 3); }

}  // namespace

const json& schema() {
  static const json parsed = json::parse(schema_text());
  return parsed;
}

const json* schema_at(const std::vector<std::string>& path) {
  const json* node = &schema();
  for (const std::string& name : path) {
    const auto properties = node->find("properties");
    if (properties == node->end() || !properties->contains(name)) return nullptr;
    node = &(*properties)[name];
  }
  return node;
}

std::string expectation(const json& key_schema) {
  if (key_schema.contains("enum")) return alternatives(key_schema["enum"]);
  const std::string type = key_schema.at("type");
  if (type == "integer") return "an integer" + range(key_schema);
  if (type == "number") return "a number" + range(key_schema);
  if (type == "boolean") return "true or false";
  if (type == "string") return text_length(key_schema);
  if (type == "array")
    return "a list of at most " + key_schema.at("maxItems").dump() + ", each " +
           expectation(key_schema.at("items"));
  return "an object";
}

std::string nearest_key(const json& group_schema, std::string_view name) {
  std::string nearest;
  std::size_t least = name.size() + 1;
  for (const auto& [known, unused] : group_schema.at("properties").items()) {
    if (!name.empty() && known.starts_with(std::string(name) + "_")) return known;
    const std::size_t tolerated = tolerated_slips(known);
    if (name.size() > known.size() + tolerated) continue;
    const std::size_t distance = edit_distance(name, known);
    if (distance <= tolerated && distance < least) {
      nearest = known;
      least = distance;
    }
  }
  return nearest;
}

}  // namespace gyrod::settings
