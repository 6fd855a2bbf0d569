/// Everything that gyrod exposes to Prometheus, read from the view when asked.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "monitor/http_counts.hpp"
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
  /// Of the port that the text is asked for at.
  std::function<HttpSnapshot()> http;
};

/// Thread-safe as far as the view is; holds no state of its own.
class Collector {
 public:
  Collector(CollectorOptions options, View view);
  /// In the Prometheus text format 0.0.4.
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const CollectorOptions& options() const noexcept { return options_; }

 private:
  CollectorOptions options_;
  View view_;
};

}  // namespace gyrod::monitor
