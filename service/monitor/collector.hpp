/// Everything that gyrod exposes to Prometheus, read from the view when asked.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <prometheus/collectable.h>
#include <prometheus/metric_family.h>

#include "monitor/view.hpp"

namespace gyrod::monitor {

/// What the collector knows besides the view.
struct CollectorOptions {
  std::size_t max_channel_series = 200;
  std::string version = "unknown";
  /// When the process began, s since the Unix epoch.
  double start_time_s = 0.0;
  /// Seconds since then; tests inject their own.
  std::function<double()> uptime_s;
};

/// Thread-safe as far as the view is; holds no state of its own.
class Collector final : public prometheus::Collectable {
 public:
  Collector(CollectorOptions options, View view);
  [[nodiscard]] std::vector<prometheus::MetricFamily> Collect() const override;

 private:
  CollectorOptions options_;
  View view_;
};

}  // namespace gyrod::monitor
