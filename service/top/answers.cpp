#include "top/answers.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "top/printable.hpp"

namespace gyrod::top {
namespace {

using Json = nlohmann::json;

[[noreturn]] void break_off(const std::string& key, const char* expected) {
  throw AnswerError("the answer is not that of gyrod's API: expected " + std::string(expected) + " as " +
                    key);
}

/// Of an object, the value at a key, with the path to it for messages. What is left out counts as null, which stands for not known.
class Field {
 public:
  Field(const Json& object, std::string path) : value_(&object), path_(std::move(path)) {}

  [[nodiscard]] Field operator[](const char* key) const {
    static const Json none;
    if (!value_->is_object()) break_off(path_, "an object");
    const auto found = value_->find(key);
    return {found == value_->end() ? none : *found, path_ + "." + key};
  }
  [[nodiscard]] Figure figure() const {
    if (value_->is_null()) return std::nullopt;
    if (!value_->is_number()) break_off(path_, "a number or null");
    return value_->get<double>();
  }
  [[nodiscard]] std::uint64_t count() const {
    if (!value_->is_number_unsigned()) break_off(path_, "a count");
    return value_->get<std::uint64_t>();
  }
  [[nodiscard]] std::optional<bool> truth() const {
    if (value_->is_null()) return std::nullopt;
    if (!value_->is_boolean()) break_off(path_, "true or false");
    return value_->get<bool>();
  }
  [[nodiscard]] std::string text() const {
    if (!value_->is_string()) break_off(path_, "text");
    return printable(value_->get_ref<const std::string&>());
  }
  [[nodiscard]] std::string text_or_none() const { return value_->is_null() ? std::string{} : text(); }
  [[nodiscard]] std::map<std::string, std::uint64_t> counts() const {
    if (!value_->is_object()) break_off(path_, "an object");
    std::map<std::string, std::uint64_t> all;
    for (const auto& [key, value] : value_->items())
      all[printable(key)] = Field(value, path_ + "." + printable(key)).count();
    return all;
  }
  [[nodiscard]] std::vector<Field> list() const {
    if (!value_->is_array()) break_off(path_, "a list");
    std::vector<Field> all;
    for (const Json& item : *value_) all.emplace_back(item, path_ + "[" + std::to_string(all.size()) + "]");
    return all;
  }
  [[nodiscard]] std::vector<Field> list_or_none() const {
    return value_->is_null() ? std::vector<Field>{} : list();
  }

 private:
  const Json* value_;
  std::string path_;
};

Json parse(std::string_view text) {
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) throw AnswerError("the answer is not JSON: is this a gyrod?");
  return json;
}

Axis axis_of(const Field& axis) {
  return {.health = axis["health"].text(),
          .noise_in_radps = axis["noise_in_radps"].figure(),
          .noise_out_radps = axis["noise_out_radps"].figure(),
          .reduction_db = axis["reduction_db"].figure()};
}

Sensor sensor_of(const Field& row) {
  Sensor sensor{.name = row["sensor"].text(),
                .health = row["health"].text(),
                .sample_rate_hz = row["sample_rate_hz"].figure(),
                .overload_step = row["overload_step"].count(),
                .noise_source = row["noise_source"].text(),
                .at_rest = row["at_rest"].truth(),
                .received = row["received"].count(),
                .published = row["published"].count(),
                .rejected = row["rejected"].count(),
                .missing = row["missing"].count(),
                .axes = {}};
  for (const Field& axis : row["axes"].list()) sensor.axes.push_back(axis_of(axis));
  return sensor;
}

}  // namespace

Figure Sensor::lost_share() const {
  const std::uint64_t sent = received + missing;
  if (sent == 0) return std::nullopt;
  return static_cast<double>(missing + rejected) / static_cast<double>(sent);
}

const Axis* Sensor::loudest() const {
  const auto found =
      std::ranges::max_element(axes, {}, [](const Axis& axis) { return axis.noise_in_radps.value_or(-1.0); });
  return found == axes.end() ? nullptr : &*found;
}

Status parse_status(std::string_view json) {
  const Json whole = parse(json);
  const Field status(whole, "status");
  Status result{.version = status["version"].text(),
                .uptime_s = status["uptime_s"].figure().value_or(0.0),
                .ready = status["ready"].truth().value_or(false),
                .ready_reason = status["ready_reason"].text_or_none(),
                .samples_per_s = status["rates"]["samples_per_s"].figure(),
                .windows_per_s = status["rates"]["windows_per_s"].figure(),
                .latency_p99_s = status["added_latency_s"]["p99"].figure(),
                .workers = status["workers"].count(),
                .workers_busy = status["workers_busy"].count(),
                .queued_windows = status["queued_windows"].count(),
                .overload_step = status["overload_step"].count(),
                .open = status["channels"]["open"].count(),
                .by_health = status["channels"]["by_health"].counts(),
                .matched_writers = status["bus"]["matched_writers"].count(),
                .input_topics = {},
                .simulate_hint = status["bus"]["simulate_hint"].text_or_none()};
  for (const Field& topic : status["bus"]["input_topics"].list_or_none())
    result.input_topics.push_back(topic.text());
  return result;
}

SensorPage parse_sensors(std::string_view json) {
  const Json whole = parse(json);
  const Field answer(whole, "channels");
  SensorPage page{.total = answer["total"].count(),
                  .matching = answer["matching"].count(),
                  .offset = answer["offset"].count(),
                  .sensors = {}};
  for (const Field& row : answer["channels"].list()) page.sensors.push_back(sensor_of(row));
  return page;
}

std::vector<Event> parse_events(std::string_view json) {
  const Json whole = parse(json);
  std::vector<Event> events;
  for (const Field& event : Field(whole, "events")["events"].list())
    events.push_back({event["time_s"].figure().value_or(0.0), event["text"].text()});
  return events;
}

std::string parse_error(std::string_view json) {
  const Json whole = Json::parse(json, nullptr, /*allow_exceptions=*/false);
  if (!whole.is_object() || !whole.contains("error") || !whole["error"].is_string()) return {};
  return printable(whole["error"].get_ref<const std::string&>());
}

}  // namespace gyrod::top
