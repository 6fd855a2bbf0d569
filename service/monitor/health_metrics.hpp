/// Metrics of the sensors' health, and of what is known of their noise at rest.
#pragma once

#include <span>
#include <vector>

#include <prometheus/metric_family.h>

#include "stream/counters.hpp"

namespace gyrod::monitor {

/// How many sensors are in which state, all of them.
void add_health_totals(const stream::EngineSnapshot& engine, std::vector<prometheus::MetricFamily>& families);

/// State, Allan figures and models of the sensors shown. What is not known, or not observable, has no series.
void add_health_metrics(std::span<const stream::ChannelSnapshot> shown,
                        std::vector<prometheus::MetricFamily>& families);

}  // namespace gyrod::monitor
