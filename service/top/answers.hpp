/// What `gyrod top` takes of the answers of the HTTP API (docs/api.md). All text in them is printable (printable.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace gyrod::top {

/// The answer is not what the API says; what() names the key and what was expected.
class AnswerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A figure that may not be known yet.
using Figure = std::optional<double>;

/// gyrod's own health: /api/v1/status.
struct Status {
  std::string version;
  double uptime_s = 0.0;
  bool ready = false;
  std::string ready_reason;
  Figure samples_per_s;
  Figure windows_per_s;
  Figure latency_p99_s;
  std::uint64_t workers = 0;
  std::uint64_t workers_busy = 0;
  std::uint64_t queued_windows = 0;
  std::uint64_t overload_step = 0;
  std::uint64_t open = 0;
  std::map<std::string, std::uint64_t> by_health;
  std::uint64_t matched_writers = 0;
  std::vector<std::string> input_topics;
  std::string simulate_hint;
};

struct Axis {
  std::string health;
  Figure noise_in_radps;
  Figure noise_out_radps;
  Figure reduction_db;
};

struct Sensor {
  std::string name;
  std::string health;
  Figure sample_rate_hz;
  std::uint64_t overload_step = 0;
  std::string noise_source;
  std::optional<bool> at_rest;
  std::uint64_t received = 0;
  std::uint64_t published = 0;
  std::uint64_t rejected = 0;
  std::uint64_t missing = 0;
  std::vector<Axis> axes;

  /// Share of what was sent that is missing or was refused, since its channel opened. Nothing where nothing was sent.
  [[nodiscard]] Figure lost_share() const;
  /// The loudest axis that is known, or the first; nothing where there is none.
  [[nodiscard]] const Axis* loudest() const;
};

/// A part of the sensors: /api/v1/channels.
struct SensorPage {
  std::uint64_t total = 0;     ///< of all
  std::uint64_t matching = 0;  ///< of those that search and states choose
  std::uint64_t offset = 0;    ///< of the first of `sensors` among them
  std::vector<Sensor> sensors;
};

/// Something that happened: /api/v1/events.
struct Event {
  double time_s = 0.0;  ///< since 1970
  std::string text;     ///< one plain sentence
};

/// @throws AnswerError
[[nodiscard]] Status parse_status(std::string_view json);
[[nodiscard]] SensorPage parse_sensors(std::string_view json);
[[nodiscard]] std::vector<Event> parse_events(std::string_view json);
/// The words of an answer that says what is wrong, or nothing.
[[nodiscard]] std::string parse_error(std::string_view json);

}  // namespace gyrod::top
