#include "monitor/status_json.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "live/live.hpp"

namespace gyrod::monitor {
namespace {

Json quantiles(const stream::TimeHistogram& lately, const stream::TimeHistogram& since_start) {
  const stream::TimeHistogram& times = lately.count > 0 ? lately : since_start;
  return {{"p50", json_of(live::quantile(times, 0.5))}, {"p99", json_of(live::quantile(times, 0.99))}};
}

Json json_of(const BusSnapshot& bus, const InputFacts& input) {
  Json incompatible = Json::array();
  for (const IncompatiblePeers& kind : bus.incompatible_peers) {
    if (kind.peers == 0) continue;
    incompatible.push_back({{"direction", kind.direction}, {"policy", kind.policy}, {"peers", kind.peers}});
  }
  Json readers = Json::array();
  for (const TopicReaders& topic : bus.matched_readers)
    readers.push_back({{"topic", topic.topic}, {"readers", topic.readers}});
  return {{"domain", input.domain},
          {"input_topics", input.topics},
          {"simulate_hint", input.simulate_command},
          {"matched_writers", bus.matched_writers},
          {"matched_readers", std::move(readers)},
          {"malformed_messages", bus.malformed_messages},
          {"refusals", bus.refusals},
          {"write_errors", bus.write_errors},
          {"incompatible_peers", std::move(incompatible)},
          {"deadlines_missed", bus.deadlines_missed},
          {"liveliness_lost", bus.liveliness_lost},
          {"ros2_topics", bus.ros2_topics},
          {"ros2_refused_topics", bus.ros2_refused_topics},
          {"ros2_dropped_messages", bus.ros2_dropped_messages},
          {"certificate_expiry_s", monitor::json_of(bus.certificate_expiry_s)},
          {"refused_peers", bus.refused_peers ? Json(*bus.refused_peers) : Json(nullptr)}};
}

Json json_of(const FleetSnapshot& fleet) {
  return {{"shard", fleet.shard},
          {"active", fleet.active},
          {"peers", fleet.peers},
          {"twins", fleet.twins},
          {"overlapping", fleet.overlapping},
          {"missing", fleet.active ? Json(fleet.missing) : Json(nullptr)},
          {"disputes", fleet.disputes},
          {"foreign_samples", fleet.foreign_samples}};
}

Json json_of(const std::optional<StandbySnapshot>& standby) {
  if (!standby) return nullptr;
  return {{"others", standby->others},
          {"sensors", standby->sensors},
          {"held", standby->held},
          {"let_go", standby->let_go},
          {"takeovers", standby->takeovers}};
}

Json json_of_channels(const stream::EngineSnapshot& engine) {
  Json by_health;
  for (std::size_t i = 0; i < stream::kHealthStates; ++i)
    by_health[std::string(stream::name_of(static_cast<stream::Health>(i)))] = engine.channels_by_health[i];
  return {{"open", engine.channels},
          {"silent", engine.silent_channels},
          {"forgotten", engine.forgotten_channels},
          {"by_health", std::move(by_health)}};
}

}  // namespace

std::string epoch_of(double start_time_s) { return std::to_string(std::llround(start_time_s * 1e6)); }

Json status_json(const View& view, const ApiOptions& options, int overload_step) {
  const stream::EngineSnapshot engine = view.engine();
  const Readiness readiness = view.readiness();
  const BusSnapshot bus = view.bus();
  const live::Recent::Figures recent =
      view.live != nullptr ? view.live->recent.figures() : live::Recent::Figures{};
  return {{"api", "v1"},
          {"version", options.version},
          {"time_s", options.time_s()},
          {"start_time_s", options.start_time_s},
          {"uptime_s", options.uptime_s()},
          {"epoch", epoch_of(options.start_time_s)},
          {"ready", readiness.ready},
          {"ready_reason", readiness.ready ? Json(nullptr) : Json(readiness.reason)},
          {"samples", monitor::json_of(engine.totals)},
          {"rates",
           {{"samples_per_s", monitor::json_of(recent.samples_per_s)},
            {"windows_per_s", monitor::json_of(recent.windows_per_s)}}},
          {"windows", engine.totals.windows},
          {"queued_windows", engine.queued_windows},
          {"workers", engine.workers},
          {"workers_busy", engine.workers_busy},
          {"window_time_s", quantiles(recent.window_time, engine.window_time)},
          {"added_latency_s", quantiles(recent.added_latency, engine.added_latency)},
          {"overload_step", overload_step},
          {"channels", json_of_channels(engine)},
          {"bus", json_of(bus, view.input)},
          {"fleet", json_of(view.fleet())},
          {"standby", json_of(bus.standby)},
          {"state_file_errors", view.state_file_errors ? Json(view.state_file_errors()) : Json(nullptr)}};
}

}  // namespace gyrod::monitor
