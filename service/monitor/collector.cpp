#include "monitor/collector.hpp"

#include <cassert>
#include <utility>

#include "monitor/engine_metrics.hpp"
#include "monitor/health_metrics.hpp"
#include "monitor/sensor_metrics.hpp"

namespace gyrod::monitor {

Collector::Collector(CollectorOptions options, View view)
    : options_(std::move(options)), view_(std::move(view)) {
  assert(options_.uptime_s && view_.engine && view_.channels && view_.bus && view_.readiness);
}

std::vector<prometheus::MetricFamily> Collector::Collect() const {
  std::vector<prometheus::MetricFamily> families;
  const stream::EngineSnapshot engine = view_.engine();
  add_process_metrics(options_.version, options_.start_time_s, options_.uptime_s(), families);
  add_bus_metrics(view_.bus(), view_.readiness(), families);
  add_fleet_metrics(view_.fleet(), families);
  if (view_.state_file_errors) add_state_file_metrics(view_.state_file_errors(), families);
  add_engine_metrics(engine, families);
  add_health_totals(engine, families);
  const std::vector<stream::ChannelSnapshot> shown = view_.channels(options_.max_channel_series);
  add_sensor_metrics(shown, engine.channels, families);
  add_health_metrics(shown, families);
  return families;
}

}  // namespace gyrod::monitor
