/// What the bus adapter can be told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/qos_profile.hpp"
#include "fleet/shard.hpp"
#include "ros2/names.hpp"

namespace gyrod::bus {

/// What a reader's cache does when samples come faster than they are taken.
enum class History {
  kKeepAll,   ///< refuses more, so that a reliable writer has to wait: nothing is lost
  kKeepLast,  ///< drops the oldest of the sensor: a late reader never slows a writer
};

struct TopicNames {
  std::string raw = "gyro/raw";                        ///< in: GyroSample
  std::string raw_batch = "gyro/raw_batch";            ///< in: GyroBatch
  std::string denoised = "gyro/denoised";              ///< out: DenoisedSample
  std::string denoised_batch = "gyro/denoised_batch";  ///< out: DenoisedBatch
  std::string noise = "gyro/noise";                    ///< out: NoiseReport
  std::string health = "gyro/health";                  ///< out: HealthReport
  std::string realtime = "gyro/realtime";              ///< out, see BusOptions::realtime: DenoisedSample
  std::string realtime_batch = "gyro/realtime_batch";  ///< out, see BusOptions::realtime: DenoisedBatch
};

/// ROS 2 topics of type sensor_msgs/msg/Imu.
struct Ros2Options {
  /// In: topics, or patterns of topics (ros2/names.hpp). A topic is opened at once, one that matches a pattern when a publisher
  /// of it appears. The topic's name is the sensor's id.
  std::vector<std::string> topics;

  /// How the outputs of a topic are named. What is named so is never read.
  ros2::OutputRule outputs;

  /// Input, as BusOptions::input_reliability.
  InputReliability input_reliability = InputReliability::kAuto;

  /// Output: kBestEffort is what ROS 2 nodes do with sensor data.
  Reliability output_reliability = Reliability::kBestEffort;

  /// What is asked of publishers, and offered to subscriptions.
  QosProfile input;
  QosProfile output;

  /// Messages of one topic that DDS holds for gyrod, and for a reliable reader that is late. 1..65536. The oldest gives way.
  std::size_t depth = 1024;

  /// Topics that are opened at the most. 1..1024. Bounds memory and threads' work under a flood of topics.
  std::size_t max_topics = 64;

  /// Messages of one topic that may wait for their denoised rates: what the engine holds of a sensor at the most, and the one on
  /// its way in.
  std::size_t max_held_messages = 2048;
};

/// Effect, unit, range and consequence of every option; the defaults lose nothing and bound everything.
struct BusOptions {
  /// Which DDS domain to join. Programs in different domains do not see one another. 0..230.
  std::uint32_t domain_id = 0;

  /// Which network DDS may use:
  ///   "loopback"  this machine only (config/cyclonedds/loopback.xml, built in);
  ///   "default"   CYCLONEDDS_URI if set, else Cyclone's own choice of interface;
  ///   else        path of a Cyclone DDS XML file.
  /// The default sends nothing to any network until someone asks for it.
  std::string network = "loopback";

  TopicNames topics;

  Ros2Options ros2;

  /// Which sensors are served here where several daemons share them (FleetMembers); ROS 2 topics of other shards are not opened.
  /// None: all, as shard 1/1 that does not wait for others when it starts.
  std::optional<fleet::Shard> shard;

  /// Input: whom the raw topics are read from, and whether losses are repaired. kAuto opens a second reader of a topic once a
  /// best-effort writer of it appears; each writer's samples are handed on once.
  InputReliability input_reliability = InputReliability::kAuto;

  /// Input: what is asked of the sensors' writers. `replay` and `simulate` offer the same.
  QosProfile input;

  /// Input: kKeepAll slows reliable writers down to gyrod's pace (replay --speed max loses nothing);
  /// kKeepLast loses the oldest samples of a sensor when gyrod is late by more than input_depth messages.
  History input_history = History::kKeepAll;

  /// Input: what sensors keep for readers that come later is read, too; only writers that keep something (transient local) match then.
  bool input_past = false;

  /// Input, kKeepLast only: messages kept per sensor. 1..65536. More bridges longer stalls and costs memory.
  std::size_t input_depth = 1024;

  /// Input, kKeepAll only: messages kept per topic, over all sensors. 16..1000000. Bounds the cache at this
  /// many messages; at 64 samples a batch the default is 11 MB. When it is full writers wait.
  std::size_t input_max_messages = 4096;

  /// Input: sensor ids the middleware keeps track of per topic. 1..1000000. An id is forgotten when its
  /// writers unregister it or go. Bounds memory under a flood of ids (some 500 bytes each). Keep it well
  /// above the engine's max_channels, which refuses ids one by one and counts them: beyond this limit a
  /// reliable message of a new id is refused again and again (refusals() grows), and on a network all input
  /// that arrives after it waits with it, since Cyclone delivers on one thread, until its writer goes.
  std::size_t max_instances = 65536;

  /// Output: kReliable serves every reader; kBestEffort serves best-effort readers only.
  Reliability output_reliability = Reliability::kReliable;

  /// Output: what is offered to readers of the denoised topics. The noise topic, whose reports come once a hop, takes the partitions
  /// of it only.
  QosProfile output;

  /// Output: messages kept per sensor and topic for readers that are late. 1..65536. A reliable reader that
  /// lags by more loses the oldest; gyrod itself never waits for a reader.
  std::size_t output_depth = 1024;

  /// Output: 0 for shared ownership; else exclusive ownership of this strength, see bus/standby.hpp.
  std::uint32_t ownership_strength = 0;

  /// Output, exclusive ownership only: how long a sample may be missing from the other daemons' output before this one publishes it, s.
  /// 0.1..60. Readers take a daemon for dead after half of it.
  double takeover_s = 0.5;

  /// Output: whether the topics of estimates without look-ahead are offered. Only model methods make such estimates.
  bool realtime = false;

  /// What differs for single topics, gyrod's own and those of ROS 2. Of several, the last that says something holds.
  std::vector<TopicQos> topic_qos = {};

  /// Samples of one batch message. 1..65536. Output: a longer run is split. Input: a longer batch is refused
  /// and counted.
  std::size_t max_batch_samples = 1024;
};

/// The options with what differs for this topic, in every group: whoever opens it looks at its own.
[[nodiscard]] BusOptions for_topic(BusOptions options, std::string_view topic);

/// Longest sensor id in characters: the bound of the key in idl/gyrod.idl.
inline constexpr std::size_t kMaxSensorIdLength = 64;

/// Whether the id fits the wire: 1..64 characters, none of them NUL.
[[nodiscard]] constexpr bool fits_wire(std::string_view sensor) noexcept {
  return !sensor.empty() && sensor.size() <= kMaxSensorIdLength &&
         sensor.find('\0') == std::string_view::npos;
}

}  // namespace gyrod::bus
