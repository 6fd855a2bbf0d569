/// What the monitor may read, and nothing else. The app fills it with calls into the engine and the bus;
/// tests with fixed values. Every function is called at scrape time from the monitor's threads, several at
/// once, so it must be thread-safe, and it must not wait for samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stream/counters.hpp"

namespace gyrod::monitor {

/// The bus as monitoring sees it at one moment, in plain numbers.
struct BusSnapshot {
  std::size_t matched_writers = 0;  ///< writers that send to our raw topics
  std::uint64_t malformed_messages =
      0;                           ///< taken and dropped whole: no usable sensor id, or too long a batch
  std::uint64_t refusals = 0;      ///< times a full cache had a message wait at its writer, or lost it
  std::uint64_t write_errors = 0;  ///< messages that DDS did not take from us
  std::size_t ros2_topics = 0;     ///< ROS 2 topics that are open
  std::uint64_t ros2_refused_topics = 0;    ///< that matched a pattern and were not opened
  std::uint64_t ros2_dropped_messages = 0;  ///< ROS 2 messages without a place to wait for their rates
  /// With DDS Security: when the first certificate in use ends, s since 1970.
  std::optional<double> certificate_expiry_s = {};
  std::optional<std::uint64_t> refused_peers = {};  ///< with DDS Security: programs that were not let in
};

/// Whether work can be done now.
struct Readiness {
  bool ready = false;
  std::string reason;  ///< why not, in a few words, e.g. "stopping"; unused when ready
};

/// All four must be set.
struct View {
  std::function<stream::EngineSnapshot()> engine;
  std::function<std::vector<stream::ChannelSnapshot>(std::size_t limit)> channels;
  std::function<BusSnapshot()> bus;
  std::function<Readiness()> readiness;
};

}  // namespace gyrod::monitor
