#include "monitor/engine_metrics.hpp"

#include <array>
#include <cstdint>

#include "monitor/metric_builders.hpp"

namespace gyrod::monitor {
namespace {

using Families = std::vector<prometheus::MetricFamily>;

struct CountMetric {
  const char* name;
  const char* help;
  prometheus::MetricType type;
  std::uint64_t stream::Counts::*count;
};

using stream::Counts;
constexpr std::array<CountMetric, 15> kCounts = {{
    {"gyrod_samples_received_total", "Samples that arrived.", kCounter, &Counts::received},
    {"gyrod_samples_published_total", "Samples released to the output topics.", kCounter, &Counts::published},
    {"gyrod_samples_in_flight", "Samples accepted and not released yet.", kGauge, &Counts::in_flight},
    {"gyrod_samples_missing_total", "Samples that never arrived, by sequence number or stamp.", kCounter,
     &Counts::missing},
    {"gyrod_samples_bridged_total", "Missing samples interpolated inside windows, never published.", kCounter,
     &Counts::bridged},
    {"gyrod_samples_warming_up_total", "Samples published before their window was full.", kCounter,
     &Counts::warming_up},
    {"gyrod_samples_passed_through_total", "Samples published undenoised.", kCounter,
     &Counts::passed_through},
    {"gyrod_gaps_total", "Gaps too long to bridge: the window was closed.", kCounter, &Counts::gaps},
    {"gyrod_restarts_total", "Sequence restarts and clock steps: the window was closed.", kCounter,
     &Counts::restarts},
    {"gyrod_windows_total", "Windows processed.", kCounter, &Counts::windows},
    {"gyrod_hops_widened_total", "Times overload step 1 was entered or deepened: a wider hop.", kCounter,
     &Counts::hops_widened},
    {"gyrod_overloads_total", "Times overload step 2 was entered: pass-through.", kCounter,
     &Counts::overloads},
    {"gyrod_samples_realtime_total", "Samples estimated without look-ahead too, by a model method.", kCounter,
     &Counts::realtime},
    {"gyrod_model_misfits_total", "Times the model of an axis ceased to explain the input.", kCounter,
     &Counts::misfits},
    {"gyrod_silences_total", "Times a sensor sent nothing for so long that its window was closed.", kCounter,
     &Counts::silences},
}};

prometheus::MetricFamily rejected_by_reason(const stream::Counts& counts) {
  prometheus::MetricFamily rejected =
      family("gyrod_samples_rejected_total", "Samples refused, each under one reason.", kCounter);
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    const std::string reason(stream::name_of(static_cast<stream::RejectReason>(i)));
    rejected.metric.push_back(
        metric(kCounter, static_cast<double>(counts.rejected[i]), {{"reason", reason}}));
  }
  return rejected;
}

void add(Families& families, prometheus::MetricType type, const char* name, const char* help,
         std::uint64_t value) {
  families.push_back(single(name, help, type, static_cast<double>(value)));
}

void add_standby_metrics(const StandbySnapshot& standby, Families& families) {
  add(families, kGauge, "gyrod_standby_others", "Other daemons that have the same output.", standby.others);
  add(families, kGauge, "gyrod_standby_sensors", "Sensors that this daemon publishes.", standby.sensors);
  add(families, kGauge, "gyrod_standby_samples_held",
      "Released samples that wait to be heard from another daemon.", standby.held);
  add(families, kCounter, "gyrod_standby_samples_let_go_total",
      "Released samples that another daemon has published.", standby.let_go);
  add(families, kCounter, "gyrod_standby_takeovers_total",
      "Times this daemon went on with a sensor where another one had published it.", standby.takeovers);
}

}  // namespace

void add_engine_metrics(const stream::EngineSnapshot& engine, Families& families) {
  for (const CountMetric& count : kCounts) {
    add(families, count.type, count.name, count.help, engine.totals.*count.count);
  }
  families.push_back(rejected_by_reason(engine.totals));
  add(families, kGauge, "gyrod_sensors", "Sensors that have a channel.", engine.channels);
  add(families, kGauge, "gyrod_sensors_silent", "Sensors that have sent nothing for limits.silent_after_s.",
      engine.silent_channels);
  add(families, kCounter, "gyrod_sensors_forgotten_total",
      "Sensors whose channel closed after limits.forget_after_s.", engine.forgotten_channels);
  add(families, kGauge, "gyrod_queued_windows", "Windows that wait for a worker.", engine.queued_windows);
  add(families, kGauge, "gyrod_workers", "Worker threads.", engine.workers);
  add(families, kGauge, "gyrod_workers_busy", "Worker threads that compute a window now.",
      engine.workers_busy);
  families.push_back(histogram("gyrod_window_duration_seconds",
                               "Time a worker spent on one window of a sensor.", engine.window_time));
  families.push_back(histogram("gyrod_added_latency_seconds",
                               "Time from the sample that completed a hop to the release of the hop.",
                               engine.added_latency));
}

/// A series of each kind, also where there is none of it: an alert may then ask for a rise.
prometheus::MetricFamily incompatible_peers(const BusSnapshot& bus) {
  prometheus::MetricFamily made =
      family("gyrod_bus_incompatible_peers",
             "Writers and readers of our topics that do not match ours, by what differs.", kGauge);
  for (const IncompatiblePeers& kind : bus.incompatible_peers) {
    made.metric.push_back(metric(kGauge, static_cast<double>(kind.peers),
                                 {{"direction", kind.direction}, {"policy", kind.policy}}));
  }
  return made;
}

prometheus::MetricFamily matched_readers(const BusSnapshot& bus) {
  prometheus::MetricFamily made =
      family("gyrod_bus_matched_readers", "Readers that take a topic of gyrod's output.", kGauge);
  for (const TopicReaders& topic : bus.matched_readers)
    made.metric.push_back(metric(kGauge, static_cast<double>(topic.readers), {{"topic", topic.topic}}));
  return made;
}

void add_bus_metrics(const BusSnapshot& bus, const Readiness& readiness, Families& families) {
  add(families, kGauge, "gyrod_ready", "1 while work can be done, as /readyz says.", readiness.ready ? 1 : 0);
  add(families, kGauge, "gyrod_bus_matched_writers", "Writers that send to gyrod.", bus.matched_writers);
  families.push_back(matched_readers(bus));
  add(families, kCounter, "gyrod_bus_malformed_messages_total",
      "DDS messages dropped whole: no usable sensor id, or too long a batch.", bus.malformed_messages);
  add(families, kCounter, "gyrod_bus_refusals_total",
      "Times a full input cache refused a message; reliable writers try again.", bus.refusals);
  add(families, kCounter, "gyrod_bus_write_errors_total", "DDS messages that could not be written.",
      bus.write_errors);
  add(families, kCounter, "gyrod_bus_deadlines_missed_total",
      "Times a sensor did not send within the deadline that its writer promised.", bus.deadlines_missed);
  add(families, kCounter, "gyrod_bus_liveliness_lost_total",
      "Times a writer gave no sign of life within the lease that it promised.", bus.liveliness_lost);
  families.push_back(incompatible_peers(bus));
  add(families, kGauge, "gyrod_ros2_topics", "ROS 2 topics that are read.", bus.ros2_topics);
  add(families, kCounter, "gyrod_ros2_refused_topics_total",
      "ROS 2 topics that match a pattern and were not opened.", bus.ros2_refused_topics);
  add(families, kCounter, "gyrod_ros2_dropped_messages_total",
      "ROS 2 messages lost for want of a place to wait for their denoised rates.", bus.ros2_dropped_messages);
  if (bus.certificate_expiry_s) {
    families.push_back(single("gyrod_bus_certificate_expiry_timestamp_seconds",
                              "When the first certificate of DDS Security in use ends, since the Unix epoch.",
                              kGauge, *bus.certificate_expiry_s));
  }
  if (bus.refused_peers) {
    add(families, kCounter, "gyrod_bus_refused_peers_total", "Programs that DDS Security kept out.",
        *bus.refused_peers);
  }
  if (bus.standby) add_standby_metrics(*bus.standby, families);
}

void add_fleet_metrics(const FleetSnapshot& fleet, Families& families) {
  prometheus::MetricFamily active = family(
      "gyrod_shard_active", "1 while the shard is served, 0 while its daemon joins the others.", kGauge);
  active.metric.push_back(metric(kGauge, fleet.active ? 1.0 : 0.0, {{"shard", fleet.shard}}));
  families.push_back(std::move(active));
  add(families, kGauge, "gyrod_shard_peers", "Other daemons that write to the same topic.", fleet.peers);
  add(families, kGauge, "gyrod_shard_twins", "Other daemons that serve the same shard.", fleet.twins);
  add(families, kGauge, "gyrod_shard_overlapping_peers",
      "Daemons of another shard count whose shard overlaps this one.", fleet.overlapping);
  if (fleet.active)
    add(families, kGauge, "gyrod_shards_missing", "Shards that nobody serves in full.", fleet.missing);
  add(families, kCounter, "gyrod_shard_disputes_total",
      "Times a daemon turned up that may have served the same sensors at the same time.", fleet.disputes);
  add(families, kCounter, "gyrod_shard_foreign_samples_total",
      "Samples that came while other daemons served their sensors.", fleet.foreign_samples);
}

void add_state_file_metrics(std::uint64_t errors, Families& families) {
  add(families, kCounter, "gyrod_state_file_errors_total", "Times the noise state file could not be written.",
      errors);
}

void add_process_metrics(const std::string& version, double start_time_s, double uptime_s,
                         Families& families) {
  prometheus::MetricFamily build = family("gyrod_build_info", "Always 1; the version is a label.", kGauge);
  build.metric.push_back(metric(kGauge, 1.0, {{"version", version}}));
  families.push_back(std::move(build));
  families.push_back(single("process_start_time_seconds", "When the process began, since the Unix epoch.",
                            kGauge, start_time_s));
  families.push_back(single("gyrod_uptime_seconds", "Time since the process began.", kGauge, uptime_s));
}

}  // namespace gyrod::monitor
