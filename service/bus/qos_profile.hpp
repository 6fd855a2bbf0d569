/// What the two ends of a topic promise one another, besides history.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gyrod::bus {

/// Whether DDS repairs losses.
enum class Reliability {
  kReliable,    ///< a lost message is sent again
  kBestEffort,  ///< a lost message stays lost: lowest latency on a bad network
};

/// How a reader treats writers of both kinds.
enum class InputReliability {
  kAuto,        ///< losses of reliable writers are repaired; what others send is taken, too
  kReliable,    ///< matches reliable writers only; losses are repaired
  kBestEffort,  ///< matches every writer; losses show as gaps
};

/// How a writer shows that it lives.
enum class Liveliness {
  kAutomatic,      ///< its process lives
  kManualByTopic,  ///< it writes
};

/// What a reader asks of writers, or a writer offers to readers. A reader matches those writers only that offer at least as much; the
/// defaults ask for nothing.
struct QosProfile {
  /// Longest time between two messages of a sensor, s; 0: none. A reader notices a miss at once.
  double deadline_s = 0.0;

  Liveliness liveliness = Liveliness::kAutomatic;
  /// Longest time without a sign of life, s; 0: none but that of the process itself, which DDS notices after its lease (10 s).
  double lease_s = 0.0;

  /// Names of parts of the domain: only ends that share one meet. None: the part without a name. A reader's may hold '*' and '?'.
  std::vector<std::string> partitions;
};

/// What differs for one topic from what is said for its kind. What is empty does not differ.
struct TopicQos {
  /// Its name, or a pattern of ROS 2 topics (ros2/names.hpp).
  std::string topic;
  std::optional<InputReliability> reliability = {};  ///< kAuto: of topics that are read
  std::optional<std::size_t> depth = {};             ///< messages kept of a sensor; 0, of raw topics: all
  std::optional<double> deadline_s = {};
  std::optional<Liveliness> liveliness = {};
  std::optional<double> lease_s = {};
  std::optional<std::vector<std::string>> partitions = {};
};

}  // namespace gyrod::bus
