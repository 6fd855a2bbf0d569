#include "monitor/collector.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include <prometheus/metric_family.h>
#include <prometheus/text_serializer.h>

#include "monitor/engine_metrics.hpp"
#include "monitor/health_metrics.hpp"
#include "monitor/http_metrics.hpp"
#include "monitor/metric_builders.hpp"
#include "monitor/sensor_exposition.hpp"
#include "monitor/sensor_metrics.hpp"

namespace gyrod::monitor {

Collector::Collector(CollectorOptions options, View view)
    : options_(std::move(options)), view_(std::move(view)) {
  assert(options_.uptime_s && options_.http && view_.engine && view_.visit_channels && view_.bus &&
         view_.readiness);
}

std::string Collector::text() const {
  std::vector<prometheus::MetricFamily> families;
  const stream::EngineSnapshot engine = view_.engine();
  add_process_metrics(options_.version, options_.start_time_s, options_.uptime_s(), families);
  add_bus_metrics(view_.bus(), view_.readiness(), families);
  add_fleet_metrics(view_.fleet(), families);
  if (view_.state_file_errors) add_state_file_metrics(view_.state_file_errors(), families);
  add_http_metrics(options_.http(), families);
  add_engine_metrics(engine, families);
  add_health_totals(engine, families);

  SensorExposition sensors({sensor_metrics(), health_metrics()});
  view_.visit_channels(options_.max_channel_series,
                       [&sensors](const stream::ChannelSnapshot& sensor) { sensors.add(sensor); });
  const std::size_t omitted = engine.channels - std::min(engine.channels, sensors.sensors());
  families.push_back(single("gyrod_sensors_omitted",
                            "Sensors without series of their own (monitor.max_channel_series).", kGauge,
                            static_cast<double>(omitted)));
  std::string text = prometheus::TextSerializer().Serialize(families);
  sensors.append_to(text);
  return text;
}

}  // namespace gyrod::monitor
