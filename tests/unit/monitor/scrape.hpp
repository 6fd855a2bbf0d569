/// One scrape of a view with known values.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "monitor/collector.hpp"
#include "unit/monitor/exposition.hpp"
#include "unit/monitor/fixed_view.hpp"

namespace gyrod::monitor::test {

inline std::string exposition_of(const Shown& shown, std::size_t max_channel_series = 200) {
  const Collector collector({.max_channel_series = max_channel_series,
                             .version = "1.2.3",
                             .start_time_s = 1.7e9,
                             .uptime_s = [] { return 42.5; },
                             .http = [&shown] { return shown.http; }},
                            view_of(shown));
  return collector.text();
}

inline std::vector<Family> families_of(const Shown& shown, std::size_t max_channel_series = 200) {
  return parse_exposition(exposition_of(shown, max_channel_series));
}

}  // namespace gyrod::monitor::test
