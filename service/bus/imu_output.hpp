/// One output of a ROS 2 topic. Internal to bus/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/held_samples.hpp"
#include "bus/imu_wire.hpp"
#include "bus/other_daemons.hpp"
#include "bus/topic_reader.hpp"
#include "bus/topic_writer.hpp"

namespace gyrod::bus {

/// A message that is ready to leave.
struct ReadyImu {
  std::uint64_t sequence = 0;  ///< always: ROS 2 counts nothing
  std::int64_t stamp_ns = 0;
  Imu message{};
  std::string frame_id;  ///< what message.header.frame_id is to point to
};

/// Writes the messages of one output topic. Where daemons have the same output and differ in BusOptions::ownership_strength, one of them
/// writes a topic: the others hear it on the topic itself, by the stamps of its messages, and hold what they have (held_samples.hpp).
/// ROS 2 knows no exclusive ownership, so what two write at a time readers get twice.
///
/// One thread at a time. Allocates where it holds messages only.
class ImuOutput {
 public:
  /// @throws BusError naming topic, QoS and DDS's answer
  ImuOutput(const Domain& domain, const std::string& topic, const BusOptions& options);

  /// Writes the message with the rates of the sample, or holds it. Leaves with flush().
  void publish(const Imu& message, const stream::DenoisedSample& sample);
  void flush() const noexcept { writer_.flush(); }

  /// Looks for what others have published, and publishes what was held for too long. To be called each tick (other_daemons.hpp) where
  /// there may be others.
  void tend();

  [[nodiscard]] std::size_t matched_readers() const noexcept { return writer_.matched_readers(); }
  [[nodiscard]] bool wait_for_acknowledgements(dds_time_t deadline) const noexcept;

  /// Whether this daemon writes the topic, beside others.
  [[nodiscard]] bool active() const noexcept { return shared_ && shared_->held.active(); }
  [[nodiscard]] std::size_t held() const noexcept { return shared_ ? shared_->held.size() : 0; }
  [[nodiscard]] std::uint64_t let_go() const noexcept { return shared_ ? shared_->held.let_go() : 0; }
  [[nodiscard]] std::uint64_t takeovers() const noexcept { return shared_ ? shared_->held.takeovers() : 0; }
  /// Messages that DDS did not take.
  [[nodiscard]] std::uint64_t write_errors() const noexcept { return write_errors_; }

 private:
  /// With others.
  struct Shared {
    TopicReader<Imu> reader;
    OtherDaemons others;
    HeldSamples<ReadyImu> held;
    ReadyImu newest;  ///< kept for the memory of its frame id
  };

  void listen(double now_s);
  void settle(double now_s);
  void heed_a_pause(double now_s);
  void write(const Imu& message) noexcept;

  TopicWriter<Imu> writer_;
  std::optional<Shared> shared_;
  std::uint64_t write_errors_ = 0;
};

}  // namespace gyrod::bus
