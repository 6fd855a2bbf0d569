/// Metrics of the HTTP port itself.
#pragma once

#include <vector>

#include <prometheus/metric_family.h>

#include "monitor/http_counts.hpp"

namespace gyrod::monitor {

void add_http_metrics(const HttpSnapshot& http, std::vector<prometheus::MetricFamily>& families);

}  // namespace gyrod::monitor
