/// From the engine to the bus.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "app/published_file.hpp"
#include "bus/imu_topics.hpp"
#include "bus/publisher.hpp"
#include "bus/standby.hpp"
#include "live/live.hpp"
#include "stream/engine.hpp"

namespace gyrod::app {

/// What the engine releases goes to DDS, where it came from: to gyrod's own topics, or, of ROS 2 sensors, to theirs. While the daemon
/// runs, this waits for no reader. A stop releases in one go what took seconds to come in, more than the writers keep for readers that
/// are behind; so it waits for them, within bounds.
///
/// Where several daemons have the same output, a standby between engine and publisher decides which samples this one publishes; for ROS 2
/// topics, bus::ImuTopics does.
class ReleaseToBus final : public stream::Sink, public bus::Standby::Sink {
 public:
  /// @param depth messages that the writers keep of a sensor
  ReleaseToBus(bus::Publisher& publisher, bus::ImuTopics& imu_topics, PublishedFile& published,
               live::Live& live, std::size_t depth)
      : publisher_(publisher), imu_topics_(imu_topics), published_(published), live_(live), depth_(depth) {}

  /// @param standby none, or one that this is the sink of. Before the engine's first sample
  void go_through(bus::Standby* standby) noexcept { standby_ = standby; }

  /// From now on waits for readers, in all no longer than that.
  void wait_for_readers(std::chrono::milliseconds patience) noexcept {
    patience_ns_ = std::chrono::nanoseconds(patience).count();
  }

  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept override;
  void on_realtime(std::string_view sensor,
                   std::span<const stream::DenoisedSample> samples) noexcept override;
  void on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept override;
  void on_end(std::string_view sensor) noexcept override;
  void on_health(std::string_view sensor, const stream::SensorHealth& before,
                 const stream::SensorHealth& now) noexcept override;
  void on_forgotten(std::string_view sensor) noexcept override;

  void publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept override;
  void publish_realtime(std::string_view sensor,
                        std::span<const stream::DenoisedSample> samples) noexcept override;
  void end(std::string_view sensor) noexcept override;
  void assert_liveliness() noexcept override { publisher_.assert_liveliness(); }

 private:
  template <class Publish>
  void in_parts(std::span<const stream::DenoisedSample> samples, const Publish& publish) noexcept;
  void let_readers_catch_up(std::size_t samples) noexcept;

  bus::Publisher& publisher_;
  bus::ImuTopics& imu_topics_;
  PublishedFile& published_;
  live::Live& live_;
  bus::Standby* standby_ = nullptr;
  std::size_t depth_;
  std::atomic<std::int64_t> patience_ns_{0};
  std::atomic<std::size_t> unconfirmed_{0};  ///< samples since the readers last confirmed all
};

}  // namespace gyrod::app
