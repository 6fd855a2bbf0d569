/// What the daemon's log says while it runs: changes, not statistics (those are metrics).
#pragma once

#include <chrono>
#include <cstddef>

#include "stream/counters.hpp"

namespace gyrod::app {

/// Compares snapshots taken a second or so apart. Changes of state are logged as they come; counts that grow
/// (refused, missing samples) as a sum once a minute, so that a broken sensor cannot flood the log. One
/// thread.
class StatusLog {
 public:
  void tick(const stream::EngineSnapshot& now, std::size_t matched_writers);

 private:
  void log_changes(const stream::EngineSnapshot& now, std::size_t matched_writers) const;
  void log_growth(const stream::Counts& now);

  stream::EngineSnapshot last_;
  std::size_t last_writers_ = 0;
  stream::Counts last_sum_;  ///< at the last line about growth
  std::chrono::steady_clock::time_point next_sum_{};
};

}  // namespace gyrod::app
