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
#include "app/release_to_bus.hpp"
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
  /// To the log and, as an event, to those who look.
  void hear(monitor::Tone tone, const std::string& line);
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
