/// Metrics of the engine as a whole, of the bus, and of the process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <prometheus/metric_family.h>

#include "monitor/view.hpp"
#include "stream/counters.hpp"

namespace gyrod::monitor {

void add_engine_metrics(const stream::EngineSnapshot& engine,
                        std::vector<prometheus::MetricFamily>& families);

void add_bus_metrics(const BusSnapshot& bus, const Readiness& readiness,
                     std::vector<prometheus::MetricFamily>& families);

void add_fleet_metrics(const FleetSnapshot& fleet, std::vector<prometheus::MetricFamily>& families);
/// @param errors times the noise state file could not be written
void add_state_file_metrics(std::uint64_t errors, std::vector<prometheus::MetricFamily>& families);

/// @param start_time_s when the process began, s since the Unix epoch
void add_process_metrics(const std::string& version, double start_time_s, double uptime_s,
                         std::vector<prometheus::MetricFamily>& families);

}  // namespace gyrod::monitor
