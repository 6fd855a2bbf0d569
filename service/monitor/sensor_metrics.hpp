/// Metrics of single sensors and of their axes.
#pragma once

#include <cstddef>
#include <span>

#include <prometheus/metric_type.h>

#include "monitor/sensor_figures.hpp"
#include "stream/counters.hpp"

namespace gyrod::monitor {

/// One family: a series a sensor, or an axis. A figure that is not known yet (before a sensor's first window, a rate not estimated, a floor
/// not found) gives no series: 0 would be a lie.
struct SensorMetric {
  const char* name;
  const char* help;
  prometheus::MetricType type;  ///< counter or gauge
  bool of_axis;
  /// @param axis 0 where it is not of an axis
  Value (*value)(const stream::ChannelSnapshot&, std::size_t axis);
};

[[nodiscard]] std::span<const SensorMetric> sensor_metrics() noexcept;

}  // namespace gyrod::monitor
