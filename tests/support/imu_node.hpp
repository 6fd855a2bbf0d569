/// What a ROS 2 node does with Imu messages, on plain Cyclone DDS.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "support/imu_message.hpp"

namespace gyrod::testing {

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
