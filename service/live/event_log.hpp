/// What has happened lately, for people who look now: the last changes of health and of the daemon itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stream/health.hpp"

namespace gyrod::live {

/// A change of health of one axis, or of all at once.
struct HealthChange {
  std::optional<std::size_t> axis;  ///< none: all of them
  stream::Health from = stream::Health::kWarmingUp;
  stream::Health to = stream::Health::kWarmingUp;
  double value = 0.0;  ///< as stream::AxisHealth
  double limit = 0.0;
};

struct Event {
  std::uint64_t id = 0;  ///< from 1, without a break
  double time_s = 0.0;   ///< since 1970
  std::string sensor;    ///< empty: of the daemon
  std::optional<HealthChange> health;
  std::string text;  ///< one plain sentence
};

/// The unit of `value` and `limit` in a state; empty for a plain ratio, share or step.
[[nodiscard]] std::string_view unit_of(stream::Health state) noexcept;

/// What speaks for an axis's state, and the limit it is held against: "1.7 times its usual noise, limit 1.5". Empty for `ok`.
[[nodiscard]] std::string evidence_words(const stream::AxisHealth& axis);

/// Keeps the newest events, a bounded number; any thread may add and read. Who adds never waits for one that reads, which may be of lower
/// priority, but for the time of a swap. Where nobody settles for long, what is added beyond kCapacity is lost.
class EventLog {
 public:
  static constexpr std::size_t kCapacity = 2000;

  /// Changes of a sensor's axes: one event where all have changed alike, else one an axis.
  void add_health(double time_s, std::string_view sensor, const stream::SensorHealth& before,
                  const stream::SensorHealth& now);
  /// Of the daemon, or, with a sensor, of what the daemon did with it or makes of it.
  void add(double time_s, std::string_view sensor, std::string text);

  struct Page {
    std::vector<Event> events;   ///< oldest first
    std::uint64_t first_id = 0;  ///< of the oldest that is kept; 0 while there is none
    std::uint64_t last_id = 0;
  };
  /// The oldest `limit` events after this id; with `newest`, the newest `limit` of them.
  struct Query {
    std::uint64_t after = 0;
    std::size_t limit = kCapacity;
    std::string sensor = {};  ///< empty: all
    bool newest = false;
  };
  [[nodiscard]] Page read(const Query& query) const;
  /// Of the newest event; 0 while there is none.
  [[nodiscard]] std::uint64_t last_id() const;
  /// Takes in what was added; readers do so, too. About once a second.
  void settle() const;

 private:
  void push(Event event);
  void take_in() const;

  mutable std::mutex mutex_;  ///< taken before the inbox's
  mutable std::deque<Event> events_;
  mutable std::uint64_t last_id_ = 0;
  mutable std::mutex inbox_mutex_;
  mutable std::vector<Event> inbox_;
};

}  // namespace gyrod::live
