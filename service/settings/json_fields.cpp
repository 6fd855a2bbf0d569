#include "settings/json_fields.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "settings/document.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;

std::optional<double> finite(const json* value) {
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const double number = value->get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

}  // namespace

JsonFields::JsonFields(std::string file, const json& object, std::string prefix)
    : file_(std::move(file)), object_(object), prefix_(std::move(prefix)) {
  if (object_.is_object()) return;
  const std::string subject =
      prefix_.empty() ? "the whole file" : printable(prefix_.substr(0, prefix_.size() - 1));
  throw NoiseFileError(file_ + ": " + subject + " is " + shortened(object_) + "; expected an object");
}

const json* JsonFields::find(std::string_view key) const {
  const auto found = object_.find(std::string(key));
  return found == object_.end() ? nullptr : &*found;
}

bool JsonFields::has(std::string_view key) const { return find(key) != nullptr; }

void JsonFields::allow(std::initializer_list<std::string_view> known) const {
  for (const auto& [key, value] : object_.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string message = file_ + ": unknown key " + printable(prefix_ + key) + "; expected one of ";
    for (const std::string_view name : known) {
      if (name != *known.begin()) message += ", ";
      message += name;
    }
    throw NoiseFileError(message);
  }
}

JsonFields JsonFields::fields(std::string_view key) const {
  const json* value = find(key);
  if (value == nullptr) fail(key, "an object");
  return {file_, *value, prefix_ + std::string(key) + "."};
}

double JsonFields::number(std::string_view key) const {
  const auto value = finite(find(key));
  if (!value) fail(key, "a number");
  return *value;
}

double JsonFields::positive(std::string_view key) const {
  const auto value = finite(find(key));
  if (!value || !(*value > 0.0)) fail(key, "a number above 0");
  return *value;
}

double JsonFields::not_negative(std::string_view key) const {
  const auto value = finite(find(key));
  if (!value || *value < 0.0) fail(key, "a number of at least 0");
  return *value;
}

std::vector<double> JsonFields::numbers(std::string_view key, std::size_t most) const {
  const std::string expected = "a list of at most " + std::to_string(most) + " numbers";
  const json* value = find(key);
  if (value == nullptr || !value->is_array() || value->size() > most) fail(key, expected);
  std::vector<double> result;
  for (const json& element : *value) {
    const auto number = finite(&element);
    if (!number) fail(key, expected);
    result.push_back(*number);
  }
  return result;
}

std::vector<JsonFields> JsonFields::list(std::string_view key, std::size_t most) const {
  const json* value = find(key);
  if (value == nullptr || !value->is_array() || value->size() > most)
    fail(key, "a list of at most " + std::to_string(most) + " objects");
  std::vector<JsonFields> result;
  for (std::size_t i = 0; i < value->size(); ++i)
    result.emplace_back(file_, (*value)[i], prefix_ + std::string(key) + "." + std::to_string(i) + ".");
  return result;
}

std::string JsonFields::text(std::string_view key) const {
  const json* value = find(key);
  if (value == nullptr || !value->is_string()) fail(key, "a text");
  return value->get<std::string>();
}

void JsonFields::fail(std::string_view key, std::string_view expected) const {
  const json* value = find(key);
  const std::string found = value == nullptr ? "missing" : shortened(*value);
  throw NoiseFileError(file_ + ": " + printable(prefix_ + std::string(key)) + " is " + found + "; expected " +
                       std::string(expected));
}

json parse_versioned(const std::string& file, std::string_view text, const std::string& version_key,
                     Versions versions) {
  Document document = parse_document(text);
  if (!document.issues.empty()) throw NoiseFileError(file + ": " + document.issues.front().message);
  const JsonFields root(file, document.root);
  const json* version = root.has(version_key) ? &document.root[version_key] : nullptr;
  const bool known = version != nullptr && version->is_number_integer() && *version >= versions.oldest &&
                     *version <= versions.newest;
  const std::string range =
      versions.oldest == versions.newest
          ? std::to_string(versions.newest) + ", the version"
          : std::to_string(versions.oldest) + " to " + std::to_string(versions.newest) + ", the versions";
  if (!known) root.fail(version_key, range + " that this gyrod knows");
  return std::move(document.root);
}

}  // namespace gyrod::settings
