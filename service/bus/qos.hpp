/// Quality of service of gyrod's readers and writers. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <dds/dds.h>

#include "bus/bus_options.hpp"

namespace gyrod::bus {

/// A DDS QoS that can say in words what it asks for. Every setter returns the object, so that a profile reads
/// as a sentence.
class Qos {
 public:
  Qos();

  /// @param max_blocking how long a write may wait for a slow reader, ns
  Qos& reliable(dds_duration_t max_blocking);
  Qos& best_effort();
  Qos& keep_all();
  /// @param depth messages per sensor
  Qos& keep_last(std::size_t depth);
  /// Bounds a cache. @param max_messages over all sensors, 0 for no bound. @param max_instances sensors
  Qos& limits(std::size_t max_messages, std::size_t max_instances);
  /// A writer: a reader that comes later still gets so many of the newest messages of every sensor. 1..
  Qos& keep_for_late_joiners(std::size_t depth);
  /// A reader: asks for what writers keep for those that come later; matches no others.
  Qos& with_the_past();
  /// A writer that goes away leaves its sensors "without writers", not "disposed": a standby writer's samples
  /// stay visible.
  Qos& no_autodispose();

  /// @param seconds 0: no deadline
  Qos& deadline(double seconds);
  /// @param lease_s 0: no lease, and then the kind is left alone, too
  Qos& liveliness(Liveliness kind, double lease_s);
  /// @param names none: the part of the domain without a name
  Qos& partitions(const std::vector<std::string>& names);
  /// The three above.
  Qos& promise(const QosProfile& profile);
  /// Of the writers of a sensor, readers take the strongest that lives.
  Qos& exclusive();
  Qos& strength(std::uint32_t strength);
  /// A writer that has neither written nor said that it is alive for so long counts as gone.
  Qos& lease(double seconds);
  /// A reader: of writers in other processes only.
  Qos& ignore_own_process();

  /// What readers and writers of a topic tell all others about themselves.
  Qos& user_data(std::string_view text);

  [[nodiscard]] const dds_qos_t* get() const noexcept { return qos_.get(); }
  /// E.g. "reliable, keep last 1024".
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  Qos& say(const std::string& words);

  struct Delete {
    void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
  };
  std::unique_ptr<dds_qos_t, Delete> qos_;
  std::string text_;
};

// The options are those for the topic (for_topic).

/// gyrod's reader of raw samples.
[[nodiscard]] Qos input_reader_qos(const BusOptions& options, Reliability reliability);
/// The writer of raw samples in `replay` and `simulate`: reliable and keep all, so that it is slowed down and
/// loses nothing. Offers what input_reader_qos() asks for.
/// @param past messages of every sensor that it keeps for readers that come later; 0: none
[[nodiscard]] Qos input_writer_qos(const BusOptions& options, std::size_t past = 0);
/// gyrod's writers of denoised samples. Never wait for a reader.
[[nodiscard]] Qos output_writer_qos(const BusOptions& options);
/// gyrod's writer of noise reports: as above, and a late dashboard gets the last report of every sensor at
/// once.
[[nodiscard]] Qos report_writer_qos(const BusOptions& options);
/// A daemon's reader of what others of the same output publish: the newest of every sensor.
[[nodiscard]] Qos standby_reader_qos(const BusOptions& options);
/// Writer and reader of what daemons tell one another when sensors change hands: a daemon that comes later gets the newest, too.
[[nodiscard]] Qos hand_over_qos(const BusOptions& options);
/// The reader of `record`: keeps all, as a recording must not drop what was received. Asks for nothing else.
/// @param exclusive whether the topic's writers have exclusive ownership
[[nodiscard]] Qos recorder_qos(Reliability reliability, const std::vector<std::string>& partitions,
                               bool exclusive, const BusOptions& options);
/// The reader and the writers of a ROS 2 topic, as ROS 2 nodes have them for sensor data.
[[nodiscard]] Qos imu_reader_qos(const Ros2Options& options, Reliability reliability);
[[nodiscard]] Qos imu_writer_qos(const BusOptions& options);
/// A daemon's reader of what others of the same output publish on a ROS 2 topic.
[[nodiscard]] Qos imu_standby_reader_qos(const BusOptions& options);

}  // namespace gyrod::bus
