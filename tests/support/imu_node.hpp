/// What a ROS 2 node does with Imu messages, on plain Cyclone DDS.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <sensor_msgs_imu.h>
#include <string>
#include <vector>

#include <dds/dds.h>

namespace gyrod::testing {

/// A message that owns its frame id.
struct ImuMessage {
  sensor_msgs_msg_dds__Imu_ fields{};  ///< but for header.frame_id, which means nothing
  std::string frame_id;
};

/// Message number n, told apart from others by every bit of its fields, with these rates and stamp.
[[nodiscard]] ImuMessage imu_message(std::uint64_t n, std::int64_t stamp_ns,
                                     const std::array<double, 3>& rate_radps);

[[nodiscard]] std::int64_t stamp_ns_of(const ImuMessage& message);
[[nodiscard]] std::array<double, 3> rates_of(const ImuMessage& message);

/// Everything that gyrod must not touch, bit for bit.
struct UntouchedBits {
  std::string frame_id;
  std::vector<std::uint64_t> bits;
  bool operator==(const UntouchedBits&) const = default;
};
[[nodiscard]] UntouchedBits untouched_bits(const ImuMessage& message);

/// One publisher. It is best effort, as of sensor data, unless said otherwise.
class ImuPublisher {
 public:
  /// @param participant a DDS participant @throws std::runtime_error
  ImuPublisher(dds_entity_t participant, const std::string& topic, bool reliable = false);
  ~ImuPublisher();
  ImuPublisher(const ImuPublisher&) = delete;
  ImuPublisher& operator=(const ImuPublisher&) = delete;

  void publish(const ImuMessage& message) const;
  /// Waits until a subscription has matched.
  [[nodiscard]] bool wait_for_reader() const;

 private:
  dds_entity_t topic_;
  dds_entity_t writer_;
};

/// One subscription with sensor QoS: best effort, keep last, but deep enough for a test.
class ImuSubscription {
 public:
  ImuSubscription(dds_entity_t participant, const std::string& topic, bool reliable = false);
  ~ImuSubscription();
  ImuSubscription(const ImuSubscription&) = delete;
  ImuSubscription& operator=(const ImuSubscription&) = delete;

  /// Waits until a publisher has matched.
  [[nodiscard]] bool wait_for_writer() const;
  [[nodiscard]] std::size_t matched_writers() const;
  /// Waits until so many messages have come in all.
  [[nodiscard]] bool wait_for(std::size_t messages);
  /// Takes what has come; all messages so far.
  const std::vector<ImuMessage>& messages();

 private:
  dds_entity_t topic_;
  dds_entity_t reader_;
  std::vector<ImuMessage> messages_;
};

}  // namespace gyrod::testing
