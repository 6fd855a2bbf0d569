#include "monitor/event_json.hpp"

#include <limits>
#include <utility>

#include "monitor/api_query.hpp"

namespace gyrod::monitor {

Json json_of(const live::Event& event) {
  Json json{{"id", event.id},
            {"time_s", event.time_s},
            {"sensor", event.sensor.empty() ? Json(nullptr) : Json(event.sensor)},
            {"kind", event.health ? "health" : "daemon"},
            {"axis", nullptr},
            {"from", nullptr},
            {"to", nullptr},
            {"value", nullptr},
            {"limit", nullptr},
            {"unit", nullptr},
            {"text", event.text}};
  if (!event.health) return json;
  const live::HealthChange& change = *event.health;
  if (change.axis) json["axis"] = stream::kAxisNames[*change.axis];
  json["from"] = stream::name_of(change.from);
  json["to"] = stream::name_of(change.to);
  if (change.to == stream::Health::kOk) return json;
  json["value"] = change.value;
  json["limit"] = change.limit;
  if (!live::unit_of(change.to).empty()) json["unit"] = live::unit_of(change.to);
  return json;
}

Json events_json(const Request& request, const live::EventLog* log, const std::string& epoch) {
  const ApiQuery query(request, {"after", "epoch", "limit", "sensor"});
  live::EventLog::Query wanted;
  wanted.after = query.whole("after", 0, std::numeric_limits<std::int64_t>::max(), 0);
  wanted.limit = query.whole("limit", 1, live::EventLog::kCapacity, live::EventLog::kCapacity);
  wanted.sensor = query.text("sensor").value_or("");
  if (query.text("epoch").value_or(epoch) != epoch) wanted.after = 0;  // another run's number
  wanted.newest = !query.text("after");
  const live::EventLog::Page page = log != nullptr ? log->read(wanted) : live::EventLog::Page{};
  Json events = Json::array();
  for (const live::Event& event : page.events) events.push_back(json_of(event));
  return {{"epoch", epoch},
          {"events", std::move(events)},
          {"first_id", page.first_id},
          {"last_id", page.last_id}};
}

}  // namespace gyrod::monitor
