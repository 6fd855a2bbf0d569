/// What the monitor may read, and nothing else. The app fills it with calls into the engine and the bus;
/// tests with fixed values. Every function is called at scrape time from the monitor's threads, several at
/// once, so it must be thread-safe, and it must not wait for samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stream/counters.hpp"

namespace gyrod::live {
struct Live;
}

namespace gyrod::monitor {

/// Peers on the bus that do not match, of one kind.
struct IncompatiblePeers {
  std::string direction;  ///< "input": their writers and our readers; "output": our writers and their readers
  std::string policy;     ///< what differs, e.g. "reliability"
  std::size_t peers = 0;  ///< now
};

/// Readers that take one of our output topics.
struct TopicReaders {
  std::string topic;
  std::size_t readers = 0;  ///< now
};

/// The part of a daemon among several with the same output, at one moment.
struct StandbySnapshot {
  std::size_t others = 0;       ///< other daemons with the same output
  std::size_t sensors = 0;      ///< sensors that this one publishes
  std::size_t held = 0;         ///< samples that wait to be heard from another daemon
  std::uint64_t let_go = 0;     ///< samples that another one has published
  std::uint64_t takeovers = 0;  ///< times a sensor was taken over from another daemon
};

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
  /// Times a sensor did not send within the deadline that its writer promised.
  std::uint64_t deadlines_missed = 0;
  /// Times a writer gave no sign of life within the lease that it promised.
  std::uint64_t liveliness_lost = 0;
  std::vector<IncompatiblePeers> incompatible_peers = {};  ///< one of each kind there can be
  std::vector<TopicReaders> matched_readers = {};          ///< one of each of our output topics
  std::optional<StandbySnapshot> standby = {};             ///< none where this daemon is to be the only one
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

/// Where samples are expected from, as configured: what a page without sensors tells.
struct InputFacts {
  std::uint32_t domain = 0;
  std::vector<std::string> topics = {};
  std::string simulate_command = {};  ///< simulates a sensor for this daemon
};

using ChannelVisitor = std::function<void(const stream::ChannelSnapshot&)>;
/// More than any engine opens.
inline constexpr std::size_t kAllSensors = static_cast<std::size_t>(-1);

/// Functions up to readiness must be set.
struct View {
  std::function<stream::EngineSnapshot()> engine;
  /// Calls the visitor for up to `limit` sensors, in the order of opening.
  std::function<void(std::size_t limit, const ChannelVisitor& visit)> visit_channels;
  std::function<std::optional<stream::ChannelSnapshot>(std::string_view sensor)> channel;
  std::function<BusSnapshot()> bus;
  std::function<FleetSnapshot()> fleet;
  std::function<Readiness()> readiness;
  /// Times the noise state file could not be written; none where there is no such file.
  std::function<std::uint64_t()> state_file_errors = {};
  /// The configuration in force as JSON; none: not told.
  std::function<std::string()> config = {};
  InputFacts input = {};
  /// What is kept for those who look; none: nothing is.
  live::Live* live = nullptr;
};

}  // namespace gyrod::monitor
