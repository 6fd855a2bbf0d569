#include "monitor/api_streams.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "live/live.hpp"
#include "monitor/channel_json.hpp"
#include "monitor/channel_rows.hpp"
#include "monitor/event_json.hpp"
#include "monitor/sensor_figures.hpp"

namespace gyrod::monitor {
namespace {

constexpr double kFleetPeriodS = 1.0;
constexpr double kSamplesPeriodS = 0.1;
constexpr double kChannelPeriodS = 1.0;
constexpr double kSpectrumPeriodS = 2.0;
constexpr double kKeepAliveS = 15.0;

void append_event(std::string& text, std::string_view kind, const Json& data) {
  text += "event: ";
  text += kind;
  text += "\ndata: ";
  text += text_of(data);
  text += "\n\n";
}

/// Once a period, without catching up.
bool is_due(double now_s, double period_s, double& next_s) {
  if (now_s < next_s) return false;
  next_s = now_s + period_s;
  return true;
}

std::uint64_t place_to_go_on(const live::EventLog& log, std::string_view epoch,
                             std::string_view last_event_id) {
  const std::uint64_t newest = log.last_id();
  const std::size_t dash = last_event_id.find('-');
  const bool is_ours = dash == std::string_view::npos || last_event_id.substr(0, dash) == epoch;
  const std::string_view number = last_event_id.substr(dash == std::string_view::npos ? 0 : dash + 1);
  std::uint64_t seen = 0;
  const auto [stop, error] = std::from_chars(number.data(), number.data() + number.size(), seen);
  if (number.empty() || error != std::errc{} || stop != number.data() + number.size()) return newest;
  return is_ours && seen <= newest ? seen : 0;
}

/// The figures without what changes by itself.
std::size_t hash_of(const stream::ChannelSnapshot& channel) {
  std::string key = std::to_string(channel.last_report.model_epoch);
  for (const int part : {static_cast<int>(channel.state), static_cast<int>(channel.pass_through)})
    key += ' ' + std::to_string(part);
  if (channel.health) {
    for (const stream::AxisHealth& axis : channel.health->axis)
      key += ' ' + std::to_string(static_cast<int>(axis.state));
  }
  return std::hash<std::string>{}(key);
}

}  // namespace

EventFeed::EventFeed(const live::EventLog& log, std::string epoch, const std::string& last_event_id,
                     std::string sensor)
    : log_(log),
      epoch_(std::move(epoch)),
      sensor_(std::move(sensor)),
      after_(place_to_go_on(log, epoch_, last_event_id)) {}

void EventFeed::append_id(std::string& text, std::uint64_t event) const {
  text += "id: " + epoch_ + "-" + std::to_string(event) + "\n";
}

void EventFeed::append(std::string& text) {
  if (!std::exchange(told_place_, true)) {
    append_id(text, after_);
    text += "\n";
  }
  if (log_.last_id() == after_) return;
  const live::EventLog::Page page = log_.read({.after = after_, .sensor = sensor_});
  for (const live::Event& event : page.events) {
    append_id(text, event.id);
    append_event(text, "event", json_of(event));
  }
  after_ = page.last_id;
}

void KeepAlive::append(std::string& text, bool said, double now_s) {
  if (said || next_s_ == 0.0) {
    next_s_ = now_s + kKeepAliveS;
  } else if (is_due(now_s, kKeepAliveS, next_s_)) {
    text += ": keep-alive\n\n";
  }
}

FleetStream::FleetStream(const View& view, const ApiOptions& options, RowBoard& board,
                         const std::string& last_event_id, bool with_channels)
    : view_(view),
      options_(options),
      board_(board),
      events_(view.live->events, epoch_of(options.start_time_s), last_event_id, ""),
      with_channels_(with_channels) {}

void FleetStream::append(std::string& text) {
  const std::size_t before = text.size();
  const double now_s = options_.steady_s();
  if (is_due(now_s, kFleetPeriodS, next_s_)) {
    if (with_channels_) {
      append_channels(text, now_s);
    } else {
      append_event(text, "status", status_json(view_, options_, worst_overload_step(rows_of(view_))));
    }
  }
  events_.append(text);  // after the status, which tells whose they are
  keep_alive_.append(text, text.size() > before, now_s);
}

void FleetStream::append_channels(std::string& text, double now_s) {
  const std::uint64_t round = view_.live->noise.rounds();
  const bool history = std::exchange(round_, round) != round || full_;
  const auto rows = board_.look(view_, history, now_s);
  append_event(text, "status", status_json(view_, options_, rows->overload_step));
  std::string channels;
  std::unordered_set<std::string_view> here;
  for (const RowTexts::Row& row : rows->rows) {
    here.insert(row.sensor);
    const auto [told, is_new] = told_.try_emplace(row.sensor, row.hash);
    const bool changed = is_new || std::exchange(told->second, row.hash) != row.hash;
    if (!history && !changed) continue;
    if (!channels.empty()) channels += ',';
    channels += row.text;
  }
  Json gone = Json::array();
  std::erase_if(told_, [&](const auto& row) {
    if (here.contains(row.first)) return false;
    gone.push_back(row.first);
    return true;
  });
  const Json head{{"time_s", options_.time_s()},
                  {"full", std::exchange(full_, false)},
                  {"total", rows->rows.size()},
                  {"gone", std::move(gone)}};
  text += "event: channels\ndata: " + text_of(head);
  text.pop_back();  // the brace: the rows are text already
  text += ",\"channels\":[" + channels + "]}\n\n";
}

SensorStream::SensorStream(const View& view, const ApiOptions& options, std::string sensor,
                           const SamplesQuery& query, const std::string& last_event_id)
    : view_(view),
      options_(options),
      sensor_(std::move(sensor)),
      query_(query),
      frames_(query),
      events_(view.live->events, epoch_of(options.start_time_s), last_event_id, sensor_) {}

void SensorStream::append(std::string& text) {
  const std::size_t before = text.size();
  const double now_s = options_.steady_s();
  events_.append(text);
  if (is_due(now_s, kSamplesPeriodS, next_samples_s_)) {
    const auto channel = view_.channel(sensor_);
    if (!channel) throw std::runtime_error(sensor_ + " is forgotten");
    if (is_due(now_s, kChannelPeriodS, next_channel_s_)) append_channel(text, *channel);
    const auto watched = view_.live->tap.look(sensor_, channel->sample_rate_hz, now_s);
    if (!watched) throw std::runtime_error("others are looked at");
    const SensorNow now{.sensor = sensor_, .sample_rate_hz = channel->sample_rate_hz, .now_s = now_s};
    if (const auto frame = frames_.next(*watched, now)) append_event(text, "samples", *frame);
    if (watched->raw.end() != spectrum_place_ && is_due(now_s, kSpectrumPeriodS, next_spectrum_s_)) {
      spectrum_place_ = watched->raw.end();
      append_event(text, "spectrum", spectrum_json(*watched, now, query_.seconds, noise_floors(*channel)));
    }
  }
  keep_alive_.append(text, text.size() > before, now_s);
}

void SensorStream::append_channel(std::string& text, const stream::ChannelSnapshot& channel) {
  const std::size_t hash = hash_of(channel);
  if (std::exchange(told_, hash) != hash)
    append_event(text, "channel", channel_json(channel, options_.time_s()));
}

}  // namespace gyrod::monitor
