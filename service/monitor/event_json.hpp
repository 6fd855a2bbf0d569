/// Events of health and of the daemon.
#pragma once

#include "live/event_log.hpp"
#include "monitor/answer.hpp"
#include "monitor/api_json.hpp"

namespace gyrod::monitor {

[[nodiscard]] Json json_of(const live::Event& event);

/// /api/v1/events. @param log none: no events
[[nodiscard]] Json events_json(const Request& request, const live::EventLog* log);

}  // namespace gyrod::monitor
