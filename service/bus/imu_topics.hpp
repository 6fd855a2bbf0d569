/// The ROS 2 topics that gyrod denoises: what is open, and the way out of it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bus/broken_promises.hpp"
#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/standby.hpp"
#include "bus/topic_readers.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// The ROS 2 side at one moment.
struct ImuTopicsSnapshot {
  std::size_t topics = 0;           ///< open
  std::size_t matched_writers = 0;  ///< publishers that send to them
  std::uint64_t refused_topics =
      0;  ///< of a pattern, and not opened: too many, too long a name, outputs of another, or DDS refused
  std::uint64_t malformed_messages = 0;            ///< too long a frame id
  std::uint64_t dropped_messages = 0;              ///< no place to wait for the denoised rates
  std::uint64_t write_errors = 0;                  ///< messages that DDS did not take
  std::vector<TopicReaders> matched_readers = {};  ///< of each output topic
  BrokenPromises broken_promises;                  ///< of publishers
  StandbySnapshot standby;                         ///< of the topics; how many others there are stays 0
};

/// Every open topic with its reader, its writers and the messages that wait for their denoised rates. A topic stays open as long as
/// this lives. Thread-safe.
class ImuTopics {
 public:
  /// Opens the topics that are no patterns and of this daemon's shard (BusOptions::shard); they fill their caches from now on.
  /// @throws BusError naming topic, QoS and DDS's answer
  ImuTopics(const Domain& domain, const BusOptions& options);
  ~ImuTopics();
  ImuTopics(const ImuTopics&) = delete;
  ImuTopics& operator=(const ImuTopics&) = delete;

  /// Whether a topic of that name is, or would be, read, be it by the daemon of another shard: such a sensor id is taken, nobody else may use it.
  [[nodiscard]] bool claims(std::string_view sensor) const noexcept;

  /// Publishes what the engine released of a sensor: each message as it came, but for the rates and their covariance.
  /// @return false if the sensor is no open topic
  bool publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;
  /// The same without look-ahead. Comes while the subscriber's handler is given the message. @pre BusOptions::realtime
  bool publish_realtime(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;

  /// Whether the sensor is an open topic and this daemon, of several with the same output, publishes it.
  [[nodiscard]] bool publishes(std::string_view sensor) const noexcept;

  /// Where other daemons have the same output: waits, takeover_s and a little at the most, until all that is held has been heard from them or
  /// published, and then holds and looks no more. Idempotent.
  void stop_holding() noexcept;

  /// Waits until every reliable reader has confirmed what was published. @return false if they did not in time
  bool wait_for_acknowledgements(std::chrono::milliseconds timeout) noexcept;

  [[nodiscard]] ImuTopicsSnapshot snapshot() const;

 private:
  friend class ImuSubscriber;
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
