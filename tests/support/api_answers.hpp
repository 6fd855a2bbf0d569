/// Answers of the API as its contract has them.
#pragma once

#include <string>

namespace gyrod::testing {

inline std::string status_json(const std::string& ready = "true") {
  return R"({"api": "v1", "version": "0.1.0", "time_s": 1.7e9, "uptime_s": 7500.5, "ready": )" + ready +
         R"(, "ready_reason": )" + (ready == "true" ? "null" : R"("starting or stopping")") +
         R"(, "rates": {"samples_per_s": 12345.6, "windows_per_s": null}, "added_latency_s": {"p50": 0.001, "p99": 0.0123},
    "workers": 2, "workers_busy": 1, "queued_windows": 3, "overload_step": 1,
    "channels": {"open": 2, "silent": 0, "forgotten": 0, "by_health": {"ok": 1, "noisy": 1, "stuck": 0}},
    "bus": {"matched_writers": 2, "input_topics": ["gyro/raw", "gyro/raw_batch"], "simulate_hint": "gyrod simulate"}})";
}

inline std::string axis_json(const std::string& health, const std::string& noise_in) {
  return R"({"health": ")" + health + R"(", "value": 0, "limit": 0, "noise_in_radps": )" + noise_in +
         R"(, "noise_out_radps": 0.0005, "reduction_db": 20.0})";
}

/// A sensor whose y axis is the loudest, with 0.01 rad/s.
inline std::string sensor_json(const std::string& name, const std::string& health) {
  return R"({"sensor": ")" + name + R"(", "health": ")" + health +
         R"(", "state": "active", "sample_rate_hz": 99.97, "hop_samples": 32, "overload_step": 0, "noise_source": "standstill",
    "at_rest": true, "received": 990, "published": 970, "rejected": 5, "missing": 10, "axes": [)" +
         axis_json("ok", "0.005") + "," + axis_json(health, "0.01") + "," + axis_json("ok", "null") + "]}";
}

inline std::string sensors_json(const std::string& rows, int count, int offset = 0) {
  const std::string number = std::to_string(count);
  return R"({"time_s": 1.7e9, "total": )" + number + R"(, "matching": )" + number + R"(, "offset": )" +
         std::to_string(offset) + R"(, "channels": [)" + rows + "]}";
}

inline std::string events_json() {
  return R"({"events": [{"id": 7, "time_s": 86400.0, "text": "first is ok"},
    {"id": 8, "time_s": 90061.9, "text": "front is noisy\u001b[2J"}], "first_id": 7, "last_id": 8})";
}

}  // namespace gyrod::testing
