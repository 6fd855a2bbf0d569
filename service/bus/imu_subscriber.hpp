/// Imu messages from ROS 2 topics.
#pragma once

#include <memory>
#include <string_view>

#include "bus/imu_topics.hpp"
#include "stream/counters.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// What becomes of a sample that was handed over.
enum class Fate {
  kLeaves,    ///< is published once, in order
  kMayLeave,  ///< so it is if this daemon takes the sensor over in time; another serves it now
  kDoesNot,   ///< is not
};

/// Where received messages go. Called by the subscriber's thread only.
class ImuHandler {
 public:
  virtual ~ImuHandler() = default;
  /// The newest sample of a sensor; its message waits in ImuTopics. @param sensor the topic's name, valid during the call
  /// @return what becomes of it, and so of its message
  [[nodiscard]] virtual Fate on_sample(std::string_view sensor, const stream::Sample& sample) noexcept = 0;
  /// The last publisher that sent a message has gone. Comes after the last of its samples, once until samples come again.
  virtual void on_end(std::string_view sensor) noexcept = 0;
  /// A publisher did not keep what it promised (Ros2Options::input). @param why kDeadlineMissed, or, after on_end(), kLivelinessLost
  virtual void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept = 0;
  /// A publisher of this topic appeared, and it was opened because it matches a pattern.
  virtual void on_topic(std::string_view topic, const ros2::Outputs& outputs) noexcept = 0;
  /// The same, and it was not opened. @param reason names the topic
  virtual void on_refused_topic(std::string_view reason) noexcept = 0;
};

/// Reads all open ROS 2 topics on one thread of its own, looks for publishers of topics that match a pattern, and opens those. Without
/// any topic to read it has no thread. start() and stop() belong to one thread.
class ImuSubscriber {
 public:
  /// @param topics, handler have to outlive the subscriber
  /// @throws BusError where DDS refuses
  ImuSubscriber(ImuTopics& topics, ImuHandler& handler);
  /// As by stop().
  ~ImuSubscriber();
  ImuSubscriber(const ImuSubscriber&) = delete;
  ImuSubscriber& operator=(const ImuSubscriber&) = delete;

  /// Begins to hand over. Once.
  void start();
  /// Hands over what the readers hold, and nothing any more. Idempotent.
  void stop() noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
