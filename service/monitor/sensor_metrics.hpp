/// Metrics of single sensors and of their axes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <prometheus/metric_family.h>

#include "stream/counters.hpp"

namespace gyrod::monitor {

/// Adds the series of the sensors shown, and the number of those that are not. A figure that is not known yet
/// (before a sensor's first window, a rate not estimated, a floor not found) gives no series: 0 would be a
/// lie.
/// @param sensors all sensors that there are, at least shown.size() unless some closed meanwhile
void add_sensor_metrics(std::span<const stream::ChannelSnapshot> shown, std::size_t sensors,
                        std::vector<prometheus::MetricFamily>& families);

}  // namespace gyrod::monitor
