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

/// The daemons that share the sensors, as monitoring sees them at one moment.
struct FleetSnapshot {
  std::string shard = "1/1";          ///< "index/count"
  bool active = false;                ///< serves it; false while it joins the others
  std::size_t peers = 0;              ///< other daemons that serve
  std::size_t twins = 0;              ///< those that serve the same shard
  std::size_t overlapping = 0;        ///< those of another count whose shard overlaps ours
  std::size_t missing = 0;            ///< shards that nobody serves in full
  std::uint64_t disputes = 0;         ///< times one turned up that may have served what we served
  std::uint64_t foreign_samples = 0;  ///< came in and were passed over: of sensors that others serve
};

/// Whether work can be done now.
struct Readiness {
  bool ready = false;
  std::string reason;  ///< why not, in a few words, e.g. "stopping"; unused when ready
};

/// All five must be set.
struct View {
  std::function<stream::EngineSnapshot()> engine;
  std::function<std::vector<stream::ChannelSnapshot>(std::size_t limit)> channels;
  std::function<BusSnapshot()> bus;
  std::function<FleetSnapshot()> fleet;
  std::function<Readiness()> readiness;
};

}  // namespace gyrod::monitor
