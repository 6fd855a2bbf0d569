/// /api/v1/channels/{sensor}: all that is known of one sensor.
#pragma once

#include "monitor/api_json.hpp"
#include "stream/counters.hpp"

namespace gyrod::monitor {

/// @param time_s now, since 1970
[[nodiscard]] Json channel_json(const stream::ChannelSnapshot& sensor, double time_s);

}  // namespace gyrod::monitor
