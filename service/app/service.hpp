/// The daemon's wiring: subscriber -> engine -> publisher, and the monitor beside them.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/engine_feed.hpp"
#include "app/fleet_link.hpp"
#include "app/noise_sources.hpp"
#include "app/noise_state_file.hpp"
#include "app/published_file.hpp"
#include "bus/domain.hpp"
#include "bus/fleet_members.hpp"
#include "bus/imu_subscriber.hpp"
#include "bus/imu_topics.hpp"
#include "bus/mismatch_watch.hpp"
#include "bus/peer_watch.hpp"
#include "bus/publisher.hpp"
#include "bus/standby.hpp"
#include "bus/subscriber.hpp"
#include "live/live.hpp"
#include "monitor/monitor.hpp"
#include "settings/settings.hpp"
#include "stream/engine.hpp"

namespace gyrod::app {

/// What the engine releases goes to DDS, where it came from: to gyrod's own topics, or, of ROS 2 sensors, to theirs. While the daemon
/// runs, this waits for no reader. A stop releases in one go what took seconds to come in, more than the writers keep for readers that
/// are behind; so it waits for them, within bounds.
///
/// Where several daemons have the same output, a standby between engine and publisher decides which samples this one publishes; ROS 2
/// topics know no such thing.
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

/// Owns everything that runs. One thread makes, starts and stops it; snapshot() may be called by any.
class Service {
 public:
  /// Joins the domain and takes the HTTP port; nothing flows yet.
  /// @param simulate_command what people type to simulate a sensor for this daemon
  /// @throws bus::BusError and SecurityError, Unavailable, settings::NoiseFileError for a calibration
  explicit Service(const settings::Settings& settings, std::string simulate_command = "gyrod simulate");

  void start();

  /// Source first, then what is in flight, then the publisher, then the monitor. Keeps what was learned of the noise.
  /// @return false if what was in flight had to pass through undenoised, because the deadline passed
  bool stop();

  [[nodiscard]] stream::EngineSnapshot snapshot() const { return engine_.snapshot(); }
  [[nodiscard]] std::size_t matched_writers() const {
    return subscriber_.matched_writers() + imu_topics_.snapshot().matched_writers;
  }
  /// Looks for sensors that say nothing (stream::Engine::tend): to be called about once a second.
  void tend() noexcept { inlet_.tend(); }
  /// Who we are under DDS Security, if it is used.
  [[nodiscard]] const std::optional<bus::Identity>& identity() const noexcept { return domain_.identity(); }
  /// What is to be logged of programs that DDS Security keeps out (bus::PeerWatch::look): to be called about once a second.
  [[nodiscard]] std::vector<std::string> look_at_peers();
  /// What a sensor's health and its Allan curve say (stream::Engine), and what is kept for those who look (live::Live): to be called after
  /// tend().
  void judge();
  /// Writes the noise state file if anything has been learned since the last time.
  void keep_noise();
  [[nodiscard]] const NoiseSources& noise() const noexcept { return noise_; }
  [[nodiscard]] const PublishedFile& published() const noexcept { return published_; }
  [[nodiscard]] std::size_t workers() const noexcept { return engine_.options().workers; }
  /// The HTTP port; 0 without a monitor.
  [[nodiscard]] std::uint16_t monitor_port() const noexcept {
    return monitor_ ? monitor_->port() : std::uint16_t{0};
  }

 private:
  [[nodiscard]] monitor::View view(const settings::Settings& settings, std::string simulate_command);
  [[nodiscard]] monitor::BusSnapshot bus_snapshot() const;
  [[nodiscard]] monitor::FleetSnapshot fleet_snapshot() const;
  [[nodiscard]] monitor::Readiness readiness() const;
  [[nodiscard]] std::optional<monitor::StandbySnapshot> standby_snapshot() const;

  std::chrono::milliseconds stop_deadline_;
  fleet::Shard shard_;
  std::atomic<bool> ready_{false};
  bool keeps_noise_;
  live::Live live_;
  NoiseStateFile noise_file_;
  NoiseSources noise_;
  std::uint64_t noise_kept_ = 0;  ///< revision of noise_ that the file holds
  bus::Domain domain_;
  std::optional<bus::PeerWatch> peers_;  ///< with DDS Security
  bus::Publisher publisher_;
  bus::ImuTopics imu_topics_;
  PublishedFile published_;
  ReleaseToBus release_;
  std::optional<bus::Standby> standby_;
  stream::Engine engine_;
  EngineInlet inlet_;
  FeedFromBus feed_;
  FeedFromRos2 imu_feed_;
  bus::Subscriber subscriber_;
  bus::ImuSubscriber imu_subscriber_;
  FleetLink fleet_link_;
  bus::FleetMembers fleet_;
  bus::MismatchWatch mismatch_watch_;
  std::optional<monitor::Monitor> monitor_;
};

}  // namespace gyrod::app
