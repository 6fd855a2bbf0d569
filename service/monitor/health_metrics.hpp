/// Metrics of the sensors' health, and of what is known of their noise at rest.
#pragma once

#include <span>
#include <vector>

#include <prometheus/metric_family.h>

#include "monitor/sensor_metrics.hpp"
#include "stream/counters.hpp"

namespace gyrod::monitor {

/// How many sensors are in which state, all of them.
void add_health_totals(const stream::EngineSnapshot& engine, std::vector<prometheus::MetricFamily>& families);

/// State, Allan figures and models. What is not known, or not observable, has no series.
[[nodiscard]] std::span<const SensorMetric> health_metrics() noexcept;

}  // namespace gyrod::monitor
