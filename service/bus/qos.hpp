/// Quality of service of gyrod's readers and writers. Internal to bus/: includes Cyclone's headers.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

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
  /// A reader that comes later still gets the newest message of every sensor.
  Qos& latest_for_late_joiners();
  /// A writer that goes away leaves its sensors "without writers", not "disposed": a standby writer's samples
  /// stay visible.
  Qos& no_autodispose();

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

/// gyrod's reader of raw samples.
[[nodiscard]] Qos input_reader_qos(const BusOptions& options);
/// The writer of raw samples in `replay` and `simulate`: reliable and keep all, so that it is slowed down and
/// loses nothing.
[[nodiscard]] Qos input_writer_qos();
/// gyrod's writers of denoised samples. Never wait for a reader.
[[nodiscard]] Qos output_writer_qos(const BusOptions& options);
/// gyrod's writer of noise reports: as above, and a late dashboard gets the last report of every sensor at
/// once.
[[nodiscard]] Qos report_writer_qos(const BusOptions& options);
/// The reader of `record`: keeps all, as a recording must not drop what was received.
[[nodiscard]] Qos recorder_qos(Reliability reliability, const BusOptions& options);
/// The reader and the writers of a ROS 2 topic, as ROS 2 nodes have them for sensor data.
[[nodiscard]] Qos imu_reader_qos(const Ros2Options& options);
[[nodiscard]] Qos imu_writer_qos(const Ros2Options& options);

}  // namespace gyrod::bus
