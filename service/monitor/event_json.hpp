/// Events of health and of the daemon.
#pragma once

#include <string>

#include "live/event_log.hpp"
#include "monitor/answer.hpp"
#include "monitor/api_json.hpp"

namespace gyrod::monitor {

[[nodiscard]] Json json_of(const live::Event& event);

/// /api/v1/events. @param log none: no events @param epoch of this run of gyrod
[[nodiscard]] Json events_json(const Request& request, const live::EventLog* log, const std::string& epoch);

}  // namespace gyrod::monitor
