/// One ROS 2 topic of Imu messages, with its two outputs. Internal to bus/.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/held_messages.hpp"
#include "bus/imu_output.hpp"
#include "bus/input_reader.hpp"
#include "bus/standby.hpp"
#include "bus/topic_readers.hpp"

namespace gyrod::bus {

/// What happened to messages besides the usual.
struct ImuCounts {
  std::uint64_t malformed = 0;  ///< too long a frame id: not taken
  std::uint64_t dropped =
      0;  ///< no place to wait, or denoised samples did not go with those that wait: never seen, never silent
  std::uint64_t write_errors = 0;  ///< DDS did not take a message
};

/// Reads one topic and writes its outputs. What gyrod does not denoise of a message waits here until its rates are known: the engine
/// releases each sample that it accepted once and in order, so those that wait are the messages of exactly those samples.
///
/// take(), hold(), give_up() and let_stay() belong to one thread; everything else is for any.
class ImuTopic {
 public:
  /// @throws BusError naming topic, QoS and DDS's answer
  ImuTopic(const Domain& domain, std::string name, const BusOptions& options);

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] const ros2::Outputs& outputs() const noexcept { return outputs_; }
  [[nodiscard]] InputReader<Imu>& reader() noexcept { return reader_; }
  [[nodiscard]] std::size_t matched_writers() const noexcept { return reader_.matched().current_count; }

  /// Of the topics that are written.
  void add_matched_readers(std::vector<TopicReaders>& all) const;

  /// Keeps a copy of a message until its denoised sample is published. @return false if the message is not taken, counted
  [[nodiscard]] bool hold(const Imu& message) noexcept;
  /// The engine did not accept the newest, which has that stamp.
  void give_up(std::int64_t stamp_ns) noexcept;
  /// Another daemon serves the sensor: the message with that stamp is published only if this one takes over in time.
  void let_stay(std::int64_t stamp_ns) noexcept;

  /// Writes the messages that waited for these samples, with their rates. Does not wait for readers.
  void publish(std::span<const stream::DenoisedSample> samples) noexcept;
  /// Writes messages with rates estimated without look-ahead; they wait on. Comes while the engine is given them.
  void publish_realtime(std::span<const stream::DenoisedSample> samples) noexcept;

  /// As ImuOutput::tend(), of both outputs.
  void tend() noexcept;
  /// Whether this daemon, of several with the same output, writes the topic.
  [[nodiscard]] bool publishes() const noexcept;
  /// Adds what is known of both outputs beside other daemons.
  void add_to(StandbySnapshot& standby) const noexcept;

  [[nodiscard]] bool wait_for_acknowledgements(dds_time_t deadline) const noexcept;
  [[nodiscard]] ImuCounts counts() const noexcept;

 private:
  std::string name_;
  ros2::Outputs outputs_;
  InputReader<Imu> reader_;
  mutable std::mutex mutex_;  ///< of all below; held while a message is written, which keeps them in order
  ImuOutput denoised_;
  std::optional<ImuOutput> realtime_;
  HeldMessages held_;
  ImuCounts counts_;
};

}  // namespace gyrod::bus
