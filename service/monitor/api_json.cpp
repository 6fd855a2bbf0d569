#include "monitor/api_json.hpp"

#include <cmath>

namespace gyrod::monitor {

Json json_of(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_if_known(double value) { return value > 0.0 ? json_of(value) : Json(nullptr); }

Json json_of_stamp(std::int64_t stamp_ns) { return std::to_string(stamp_ns); }

Json json_of(const stream::Counts& counts) {
  Json rejected;
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i)
    rejected[std::string(stream::name_of(static_cast<stream::RejectReason>(i)))] = counts.rejected[i];
  return {{"received", counts.received},
          {"published", counts.published},
          {"rejected", std::move(rejected)},
          {"rejected_total", counts.rejected_total()},
          {"in_flight", counts.in_flight},
          {"missing", counts.missing},
          {"bridged", counts.bridged},
          {"gaps", counts.gaps},
          {"restarts", counts.restarts},
          {"silences", counts.silences},
          {"windows", counts.windows},
          {"warming_up", counts.warming_up},
          {"passed_through", counts.passed_through},
          {"hops_widened", counts.hops_widened},
          {"overloads", counts.overloads},
          {"realtime", counts.realtime},
          {"misfits", counts.misfits}};
}

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace gyrod::monitor
