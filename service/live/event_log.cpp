#include "live/event_log.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace gyrod::live {
namespace {

std::string short_number(double value) {
  std::array<char, 32> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.4g", value);
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string sentence(std::string_view sensor, const HealthChange& change) {
  std::string text(sensor);
  if (change.axis) text += std::string(" axis ") + stream::kAxisNames[*change.axis];
  text += " is ";
  text += stream::name_of(change.to);
  text += ", before ";
  text += stream::name_of(change.from);
  const std::string evidence = evidence_words({change.to, change.value, change.limit});
  return evidence.empty() ? text + "." : text + " (" + evidence + ").";
}

bool changed(const stream::SensorHealth& before, const stream::SensorHealth& now, std::size_t axis) {
  return before.axis[axis].state != now.axis[axis].state;
}

bool all_alike(const stream::SensorHealth& before, const stream::SensorHealth& now) {
  const auto same = [](const stream::SensorHealth& health) {
    return std::ranges::all_of(
        health.axis, [&](const stream::AxisHealth& axis) { return axis.state == health.axis[0].state; });
  };
  return same(before) && same(now);
}

}  // namespace

std::string_view unit_of(stream::Health state) noexcept {
  switch (state) {
    case stream::Health::kSilent:
    case stream::Health::kStuck:
    case stream::Health::kSaturated:
      return "s";
    case stream::Health::kDrifting:
      return "rad/s";
    case stream::Health::kWarmingUp:
      return "samples";
    case stream::Health::kOk:
    case stream::Health::kDegraded:
    case stream::Health::kLossy:
    case stream::Health::kNoisy:
      break;
  }
  return "";
}

std::string evidence_words(const stream::AxisHealth& axis) {
  const std::string value = short_number(axis.value);
  const std::string limit = ", limit " + short_number(axis.limit);
  switch (axis.state) {
    case stream::Health::kSilent:
      return axis.value > axis.limit ? "no sample for " + value + " s" + limit + " s"
                                     : "its writer is gone, or has missed a deadline";
    case stream::Health::kStuck:
      return "one value for " + value + " s" + limit + " s";
    case stream::Health::kSaturated:
      return "at the end of its range " + value + " s ago" + limit + " s";
    case stream::Health::kNoisy:
      return value + " times its usual noise" + limit;
    case stream::Health::kDrifting:
      return "bias off by " + value + " rad/s" + limit + " rad/s";
    case stream::Health::kLossy:
      return short_number(100.0 * axis.value) + " % of samples missing or refused, limit " +
             short_number(100.0 * axis.limit) + " %";
    case stream::Health::kDegraded:
      return "overload step " + value + " of 2";
    case stream::Health::kWarmingUp:
      return value + " of " + short_number(axis.limit) + " samples of its window";
    case stream::Health::kOk:
      break;
  }
  return "";
}

void EventLog::add_health(double time_s, std::string_view sensor, const stream::SensorHealth& before,
                          const stream::SensorHealth& now) {
  const bool together = all_alike(before, now);
  for (std::size_t axis = 0; axis < (together ? 1 : stream::kAxes); ++axis) {
    if (!changed(before, now, axis)) continue;
    const stream::AxisHealth& is = now.axis[axis];
    const HealthChange change{.axis = together ? std::nullopt : std::optional(axis),
                              .from = before.axis[axis].state,
                              .to = is.state,
                              .value = is.value,
                              .limit = is.limit};
    push({.id = 0,
          .time_s = time_s,
          .sensor = std::string(sensor),
          .health = change,
          .text = sentence(sensor, change)});
  }
}

void EventLog::add(double time_s, std::string_view sensor, std::string text) {
  push({.id = 0,
        .time_s = time_s,
        .sensor = std::string(sensor),
        .health = std::nullopt,
        .text = std::move(text)});
}

void EventLog::push(Event event) {
  const std::lock_guard lock(inbox_mutex_);
  if (inbox_.size() < kCapacity) inbox_.push_back(std::move(event));
}

/// @pre mutex_ is held
void EventLog::take_in() const {
  std::vector<Event> added;
  {
    const std::lock_guard lock(inbox_mutex_);
    added.swap(inbox_);
  }
  for (Event& event : added) {
    if (events_.size() == kCapacity) events_.pop_front();
    event.id = last_id_ + 1;
    events_.push_back(std::move(event));
    ++last_id_;
  }
}

void EventLog::settle() const {
  const std::lock_guard lock(mutex_);
  take_in();
}

EventLog::Page EventLog::read(const Query& query) const {
  const std::lock_guard lock(mutex_);
  take_in();
  Page page;
  page.last_id = last_id_;
  page.first_id = events_.empty() ? 0 : events_.front().id;
  const auto wanted = [&query](const Event& event) {
    return query.sensor.empty() || event.sensor == query.sensor;
  };
  const auto begin = std::ranges::upper_bound(events_, query.after, {}, &Event::id);
  if (query.newest) {
    for (auto at = events_.end(); at != begin && page.events.size() < query.limit;) {
      if (wanted(*--at)) page.events.push_back(*at);
    }
    std::ranges::reverse(page.events);
    return page;
  }
  for (auto at = begin; at != events_.end() && page.events.size() < query.limit; ++at) {
    if (wanted(*at)) page.events.push_back(*at);
  }
  return page;
}

std::uint64_t EventLog::last_id() const {
  const std::lock_guard lock(mutex_);
  take_in();
  return last_id_;
}

}  // namespace gyrod::live
