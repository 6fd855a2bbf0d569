/// Short ways to make prometheus-cpp's plain metric structs.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <prometheus/metric_family.h>

#include "stream/counters.hpp"

namespace gyrod::monitor {

using Labels = std::vector<prometheus::ClientMetric::Label>;
inline constexpr auto kCounter = prometheus::MetricType::Counter;
inline constexpr auto kGauge = prometheus::MetricType::Gauge;

/// A metric of type counter or gauge, whichever its family is.
[[nodiscard]] inline prometheus::ClientMetric metric(prometheus::MetricType type, double value,
                                                     Labels labels = {}) {
  prometheus::ClientMetric made;
  made.label = std::move(labels);
  if (type == prometheus::MetricType::Counter) {
    made.counter.value = value;
  } else {
    made.gauge.value = value;
  }
  return made;
}

[[nodiscard]] inline prometheus::MetricFamily family(std::string name, std::string help,
                                                     prometheus::MetricType type) {
  return {.name = std::move(name), .help = std::move(help), .type = type, .metric = {}};
}

/// A family of one metric without labels.
[[nodiscard]] inline prometheus::MetricFamily single(std::string name, std::string help,
                                                     prometheus::MetricType type, double value) {
  prometheus::MetricFamily made = family(std::move(name), std::move(help), type);
  made.metric.push_back(metric(type, value));
  return made;
}

/// A histogram with cumulative buckets, the last one (+Inf) equal to its count.
[[nodiscard]] prometheus::MetricFamily histogram(std::string name, std::string help,
                                                 const stream::TimeHistogram& times);

}  // namespace gyrod::monitor
