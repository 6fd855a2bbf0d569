/// The configuration of the daemon as plain structs. The defaults equal those of config/gyrod.schema.json,
/// which is the one place that states type, range and meaning of every key (docs/configuration.md explains
/// them); a test compares. The comments here give only what the schema does not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/denoise/scheme.hpp"
#include "core/emd/emd.hpp"
#include "stream/engine.hpp"

namespace gyrod::settings {

enum class Reliability : std::uint8_t { kReliable, kBestEffort };
/// Of a reader: kAuto takes from reliable writers reliably, and from the others what they send.
enum class InputReliability : std::uint8_t { kAuto, kReliable, kBestEffort };
enum class Liveliness : std::uint8_t { kAutomatic, kManualByTopic };
enum class Durability : std::uint8_t { kVolatile, kTransientLocal };
enum class Method : std::uint8_t {
  kPaper,
  kJoint,  ///< the two-speed estimator, a model method
};
enum class Screening : std::uint8_t { kWindowed, kPaper, kSignificance };
/// Where the level of a sensor's own noise comes from.
enum class NoiseSource : std::uint8_t { kAuto, kCalibrated, kStandstill, kImf1 };
enum class LogLevel : std::uint8_t { kTrace, kDebug, kInfo, kWarning, kError };

struct TopicSettings {
  std::string raw = "gyro/raw";
  std::string raw_batch = "gyro/raw_batch";
  std::string denoised = "gyro/denoised";
  std::string denoised_batch = "gyro/denoised_batch";
  std::string noise = "gyro/noise";
  std::string health = "gyro/health";
  std::string realtime = "gyro/realtime";
  std::string realtime_batch = "gyro/realtime_batch";
};

/// What is asked of writers, or offered to readers; as bus::QosProfile.
struct QosSettings {
  double deadline_s = 0.0;
  Liveliness liveliness = Liveliness::kAutomatic;
  double liveliness_lease_s = 0.0;
  std::vector<std::string> partitions;
};

/// What differs for one topic, or for ROS 2 topics of a pattern, from what its group says; as bus::TopicQos.
struct TopicQosSettings {
  std::string topic;
  std::optional<InputReliability> reliability;
  std::optional<std::size_t> history_depth;
  std::optional<double> deadline_s;
  std::optional<Liveliness> liveliness;
  std::optional<double> liveliness_lease_s;
  std::optional<std::vector<std::string>> partitions;
};

struct InputSettings {
  InputReliability reliability = InputReliability::kAuto;
  /// Messages of one sensor that DDS holds for us; 0 keeps all, up to max_messages of a topic.
  std::size_t history_depth = 0;
  std::size_t max_messages = 4096;
  /// Sensor ids that DDS keeps track of in a topic; at least engine.max_channels.
  std::size_t max_sensors = 65536;
  QosSettings qos;
  Durability durability = Durability::kVolatile;
};

struct OutputSettings {
  Reliability reliability = Reliability::kReliable;
  /// Messages of one sensor and topic that DDS holds for readers that are behind.
  std::size_t history_depth = 1024;
  QosSettings qos;
  /// 0: shared ownership, no standby.
  std::uint32_t ownership_strength = 0;
  double takeover_s = 0.5;
};

struct Ros2Settings {
  /// Topics or patterns of them (ros2/names.hpp).
  std::vector<std::string> topics;
  std::string denoised_suffix = "_denoised";
  std::string realtime_suffix = "_realtime";
  InputReliability input_reliability = InputReliability::kAuto;
  Reliability output_reliability = Reliability::kBestEffort;
  std::size_t history_depth = 1024;
  std::size_t max_topics = 64;
  /// Of the inputs; the partitions are those of the outputs, too.
  QosSettings input_qos;
  /// Of the outputs, but for the partitions.
  QosSettings output_qos;
};

struct SecuritySettings {
  /// Folder of certificates, key and permissions (made absolute by loading); empty: no DDS Security.
  std::string folder;
  std::uint32_t warn_before_days = 30;
};

struct BusSettings {
  std::uint32_t domain = 0;
  /// "loopback", "default", or the path of a Cyclone DDS XML file (made absolute by loading).
  std::string network = "loopback";
  std::size_t max_batch_samples = 1024;
  /// "index/count" (fleet/shard.hpp); empty: all sensors.
  std::string shard;
  TopicSettings topics;
  InputSettings input;
  OutputSettings output;
  /// Of several for a topic, the last that says something holds.
  std::vector<TopicQosSettings> topic_qos;
  Ros2Settings ros2;
  SecuritySettings security;
};

/// What the algorithm is told; window, hop, lag and sample rate of the group `denoise` are in
/// `Settings::engine`.
struct DenoiseSettings {
  Method method = Method::kJoint;
  core::Scheme scheme = core::Scheme::kImproved;
  Screening screening = Screening::kWindowed;
  int sifts = 10;
  core::BoundaryRule boundary = core::BoundaryRule::kMirror;
  std::size_t max_ar_order = 6;
  /// What is faster counts as noise, Hz; 0: nothing does.
  double max_signal_hz = 0.0;
};

struct NoiseSettings {
  NoiseSource source = NoiseSource::kAuto;
  /// A file of `gyrod calibrate` or a folder of them (made absolute by loading; see load_calibrations()); empty: none.
  std::string calibrations;
  /// Where learned noise is kept (made absolute by loading); empty: nowhere.
  std::string state_file;
};

struct RestartSettings {
  /// Where it is kept what has been published (made absolute by loading); empty: nowhere.
  std::string published_file;
};

/// Files of the HTTP port (made absolute by loading); empty: not used.
struct MonitorTlsSettings {
  std::string certificate_file;
  std::string key_file;
};

struct MonitorAuthSettings {
  std::string token_file;
  std::string users_file;
};

struct MonitorSettings {
  bool enabled = true;
  std::string address = "127.0.0.1";
  std::uint16_t port = 9464;
  std::size_t max_channel_series = 200;
  MonitorTlsSettings tls;
  MonitorAuthSettings auth;
  /// Other machines may ask without TLS or without saying who they are.
  bool allow_insecure = false;
};

struct Settings {
  BusSettings bus;
  DenoiseSettings denoise;
  NoiseSettings noise;
  /// From the groups `denoise`, `limits` and `health`. `engine.workers` is not a key of its own: see `workers`.
  stream::EngineOptions engine;
  /// Worker threads; 0 asks for one per core. Whoever makes the Engine sets engine.workers from it.
  std::size_t workers = 0;
  RestartSettings restart;
  MonitorSettings monitor;
  double stop_deadline_s = 5.0;
  LogLevel log_level = LogLevel::kInfo;
};

}  // namespace gyrod::settings
