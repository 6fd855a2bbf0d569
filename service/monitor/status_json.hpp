/// /api/v1/status: how gyrod itself is.
#pragma once

#include <functional>
#include <string>

#include "monitor/api_json.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor {

/// What is known of the process, beside the view.
struct ApiOptions {
  std::string version = "unknown";
  /// When the process began, s since the Unix epoch.
  double start_time_s = 0.0;
  /// Seconds since then, of a steady clock.
  std::function<double()> uptime_s;
  /// Seconds of the clock of live::Live::tick().
  std::function<double()> steady_s;
  /// Now, s since the Unix epoch.
  std::function<double()> time_s;
};

/// Another text after every start of the process. @param start_time_s s since the Unix epoch
[[nodiscard]] std::string epoch_of(double start_time_s);

/// @param overload_step worst over all sensors
[[nodiscard]] Json status_json(const View& view, const ApiOptions& options, int overload_step);

}  // namespace gyrod::monitor
