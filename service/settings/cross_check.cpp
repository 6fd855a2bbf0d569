#include "settings/cross_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fleet/shard.hpp"
#include "ros2/names.hpp"
#include "settings/document.hpp"
#include "settings/enum_names.hpp"
#include "settings/noise_calibration.hpp"
#include "settings/qos_check.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class CrossCheck {
 public:
  CrossCheck(const Settings& settings, const json& document, std::vector<SettingsIssue>& issues)
      : settings_(settings), document_(document), issues_(issues) {}

  /// Window, hop and lag as documented in stream/engine.hpp.
  void check_window() {
    const stream::EngineOptions& engine = settings_.engine;
    const std::size_t half = engine.window_samples / 2;
    const std::size_t quarter = engine.window_samples / 4;
    const std::string half_words = "half of denoise.window_samples (" + std::to_string(half) + ")";
    const std::string quarter_words =
        "at most a quarter of denoise.window_samples (" + std::to_string(quarter) + ")";
    require(engine.hop_samples <= half, "denoise.hop_samples", engine.hop_samples, "at most " + half_words,
            {"denoise.window_samples"});
    require(engine.lag_samples <= quarter, "denoise.lag_samples", engine.lag_samples, quarter_words,
            {"denoise.window_samples"});
    require(engine.max_hop_samples >= engine.hop_samples && engine.max_hop_samples <= half,
            "limits.max_hop_samples", engine.max_hop_samples,
            "from denoise.hop_samples (" + std::to_string(engine.hop_samples) + ") to " + half_words,
            {"denoise.hop_samples", "denoise.window_samples"});
    require(engine.max_bridged_samples <= quarter, "limits.max_bridged_samples", engine.max_bridged_samples,
            quarter_words, {"denoise.window_samples"});
  }

  void check_method() {
    const bool is_joint = settings_.denoise.method == Method::kJoint;
    const std::string name(name_of(settings_.denoise.method));
    require(!is_joint || settings_.engine.lag_samples <= stream::kMaxModelLagSamples, "denoise.lag_samples",
            settings_.engine.lag_samples,
            "at most " + std::to_string(stream::kMaxModelLagSamples) + " where denoise.method is \"" + name +
                "\"",
            {});
  }

  /// More ids must reach the engine than it takes, or a flood of them is dropped unseen.
  void check_sensors() {
    require(settings_.bus.input.max_sensors >= settings_.engine.max_channels, "bus.input.max_sensors",
            settings_.bus.input.max_sensors,
            "at least limits.max_channels (" + std::to_string(settings_.engine.max_channels) + ")",
            {"limits.max_channels"});
  }

  void check_silence() {
    const stream::EngineOptions& engine = settings_.engine;
    const bool never = engine.forget_after_s == 0.0;
    char silent[32];
    std::snprintf(silent, sizeof silent, "%g", engine.silent_after_s);
    require(never || engine.forget_after_s >= engine.silent_after_s, "limits.forget_after_s",
            engine.forget_after_s, std::string("0, or at least limits.silent_after_s (") + silent + ")",
            {"limits.silent_after_s"});
  }

  /// A state is left no sooner than it is entered.
  void check_health() {
    const stream::HealthOptions& health = settings_.engine.health;
    const auto words = [](double value) {
      char text[32];
      std::snprintf(text, sizeof text, "%g", value);
      return " (" + std::string(text) + ")";
    };
    require(health.all_stuck_after_s >= health.stuck_after_s, "health.all_stuck_after_s",
            health.all_stuck_after_s, "at least health.stuck_after_s" + words(health.stuck_after_s),
            {"health.stuck_after_s"});
    require(health.noisy_clear_ratio <= health.noisy_ratio, "health.noisy_clear_ratio",
            health.noisy_clear_ratio, "at most health.noisy_ratio" + words(health.noisy_ratio),
            {"health.noisy_ratio"});
    require(health.lossy_clear_share <= health.lossy_share, "health.lossy_clear_share",
            health.lossy_clear_share, "at most health.lossy_share" + words(health.lossy_share),
            {"health.lossy_share"});
  }

  /// The scatter of white noise's energies is tabulated for one EMD (core/denoise/significance.hpp).
  void check_screening() {
    const DenoiseSettings& denoise = settings_.denoise;
    if (denoise.screening != Screening::kSignificance) return;
    const std::string reason = ", for which alone denoise.screening \"significance\" has its noise line";
    require(denoise.sifts == 10, "denoise.sifts", denoise.sifts, "10" + reason, {"denoise.screening"});
    require(denoise.boundary == core::BoundaryRule::kMirror, "denoise.boundary",
            std::string(name_of(denoise.boundary)), "\"mirror\"" + reason, {"denoise.screening"});
  }

  void check_topics() {
    const TopicSettings& topics = settings_.bus.topics;
    const std::array<std::pair<std::string, std::string>, 8> all = {
        {{"bus.topics.raw", topics.raw},
         {"bus.topics.raw_batch", topics.raw_batch},
         {"bus.topics.denoised", topics.denoised},
         {"bus.topics.denoised_batch", topics.denoised_batch},
         {"bus.topics.noise", topics.noise},
         {"bus.topics.health", topics.health},
         {"bus.topics.realtime", topics.realtime},
         {"bus.topics.realtime_batch", topics.realtime_batch}}};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto& [key, name] = all[i];
      require(is_topic_name(name), key, name, "letters, digits, '_' and '/', not starting with a digit", {});
      for (std::size_t earlier = 0; earlier < i; ++earlier) {
        require(name != all[earlier].second, key, name,
                "a name of its own, not that of " + all[earlier].first, {all[earlier].first});
      }
    }
  }

  void check_shard() {
    const std::string& shard = settings_.bus.shard;
    require(shard.empty() || fleet::parse_shard(shard).has_value(), "bus.shard", shard,
            "\"\", or INDEX/COUNT with 1 <= INDEX <= COUNT <= " + std::to_string(fleet::kMaxShards) +
                ", e.g. \"2/3\"",
            {});
  }

  void check_ros2() {
    const Ros2Settings& ros2 = settings_.bus.ros2;
    check_suffix("bus.ros2.denoised_suffix", ros2.denoised_suffix);
    check_suffix("bus.ros2.realtime_suffix", ros2.realtime_suffix);
    require(ros2.denoised_suffix != ros2.realtime_suffix, "bus.ros2.realtime_suffix", ros2.realtime_suffix,
            "another one than bus.ros2.denoised_suffix", {"bus.ros2.denoised_suffix"});
    for (std::size_t i = 0; i < ros2.topics.size(); ++i) check_ros2_topic(i);
  }

  void check_qos() {
    for (const Mistake& mistake : qos_mistakes(settings_.bus))
      require(false, mistake.key, mistake.value, mistake.expected, mistake.others);
  }

  /// Reads the calibrations: a start must not find out later.
  void check_calibrations(const fs::path& directory) {
    const NoiseSettings& noise = settings_.noise;
    require(noise.source != NoiseSource::kCalibrated || !noise.calibrations.empty(), "noise.calibrations",
            noise.calibrations, "a file or folder, for noise.source is \"calibrated\"", {"noise.source"});
    if (noise.calibrations.empty() || concerned(issues_, "noise.calibrations")) return;
    try {
      static_cast<void>(load_calibrations(resolved(noise.calibrations, directory)));
    } catch (const NoiseFileError& error) {
      issues_.push_back({.key = "noise.calibrations",
                         .value = shortened(noise.calibrations),
                         .expected = "calibrations that can be read",
                         .message = std::string("noise.calibrations: ") + error.what()});
    }
  }

  void check_state_file(const fs::path& directory) {
    const NoiseSettings& noise = settings_.noise;
    if (noise.state_file.empty()) return;
    std::error_code error;
    const fs::path file = resolved(noise.state_file, directory);
    require(!fs::is_directory(file, error), "noise.state_file", noise.state_file, "a file, not a folder", {});
    require(file != resolved(noise.calibrations, directory), "noise.state_file", noise.state_file,
            "another file than noise.calibrations", {"noise.calibrations"});
  }

  void check_published_file(const fs::path& directory) {
    const std::string& file = settings_.restart.published_file;
    if (file.empty()) return;
    std::error_code error;
    const fs::path path = resolved(file, directory);
    require(!fs::is_directory(path, error), "restart.published_file", file, "a file, not a folder", {});
    require(path != resolved(settings_.noise.state_file, directory), "restart.published_file", file,
            "another file than noise.state_file", {"noise.state_file"});
  }

  /// Whoever reaches the port sees every sensor: over a network nobody does unseen and unnamed by accident.
  void check_monitor() {
    const MonitorSettings& monitor = settings_.monitor;
    const MonitorTlsSettings& tls = monitor.tls;
    require(tls.certificate_file.empty() || !tls.key_file.empty(), "monitor.tls.key_file", tls.key_file,
            "the key of monitor.tls.certificate_file", {"monitor.tls.certificate_file"});
    require(tls.key_file.empty() || !tls.certificate_file.empty(), "monitor.tls.certificate_file",
            tls.certificate_file, "the certificate of monitor.tls.key_file", {"monitor.tls.key_file"});
    const std::string& address = monitor.address;
    const bool local = address == "localhost" || address == "::1" || address.starts_with("127.");
    const bool asks_who = !monitor.auth.token_file.empty() || !monitor.auth.users_file.empty();
    const bool secure = !tls.certificate_file.empty() && asks_who;
    require(!monitor.enabled || local || secure || monitor.allow_insecure, "monitor.address", address,
            "one of this machine alone, such as 127.0.0.1; or monitor.tls together with monitor.auth, so "
            "that others "
            "can neither listen nor ask without a name; or monitor.allow_insecure: true, where something "
            "else sees to "
            "that",
            {"monitor.enabled", "monitor.tls.certificate_file", "monitor.tls.key_file",
             "monitor.auth.token_file", "monitor.auth.users_file", "monitor.allow_insecure"});
  }

  void check_network(const fs::path& directory) {
    const fs::path file = network_file(settings_.bus, directory);
    std::error_code error;
    require(file.empty() || fs::is_regular_file(file, error), "bus.network", settings_.bus.network,
            "\"loopback\", \"default\" or the path of a Cyclone DDS XML file", {});
  }

 private:
  static bool is_topic_name(std::string_view name) {
    const auto allowed = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
             c == '/';
    };
    return std::all_of(name.begin(), name.end(), allowed) && !(name.front() >= '0' && name.front() <= '9');
  }

  void check_suffix(const std::string& key, const std::string& suffix) {
    require(ros2::is_suffix(suffix), key, suffix,
            "letters, digits, single '_' and '/' that can end a topic's name, and another end than _raw", {});
  }

  void check_ros2_topic(std::size_t index) {
    const std::vector<std::string>& topics = settings_.bus.ros2.topics;
    const ros2::OutputRule rule{settings_.bus.ros2.denoised_suffix, settings_.bus.ros2.realtime_suffix};
    const std::string& topic = topics[index];
    const std::string key = "bus.ros2.topics[" + std::to_string(index) + "]";
    require(ros2::is_topic_or_pattern(topic), key, topic,
            "rt/ and then names of letters, digits and single '_', with '/' between them and '*' for parts "
            "of them",
            {"bus.ros2.topics"});
    require(!ros2::is_output(topic, rule), key, topic, "a topic that does not end as gyrod's own output does",
            {"bus.ros2.topics", "bus.ros2.denoised_suffix", "bus.ros2.realtime_suffix"});
    for (std::size_t earlier = 0; earlier < index; ++earlier) {
      require(ros2::outputs_of(topic, rule).denoised != ros2::outputs_of(topics[earlier], rule).denoised, key,
              topic, "a topic with outputs of its own, not those of \"" + topics[earlier] + "\"",
              {"bus.ros2.topics"});
    }
  }

  /// @param others the keys besides `key` that the rule depends on
  void require(bool holds, const std::string& key, const json& value, const std::string& expected,
               const std::vector<std::string>& others) {
    const auto unknown = [this](std::string_view name) { return concerned(issues_, name); };
    if (holds || unknown(key) || std::any_of(others.begin(), others.end(), unknown)) return;
    const bool given = given_value(document_, key.substr(0, key.find('['))) != nullptr;
    const std::string origin = given ? "" : " (the default)";
    issues_.push_back({.key = key,
                       .value = shortened(value),
                       .expected = expected,
                       .message = key + " is " + shortened(value) + origin + "; expected " + expected});
  }

  const Settings& settings_;
  const json& document_;
  std::vector<SettingsIssue>& issues_;
};

}  // namespace

void cross_check(const Settings& settings, const json& document, const fs::path& directory,
                 std::vector<SettingsIssue>& issues) {
  CrossCheck check(settings, document, issues);
  check.check_window();
  check.check_method();
  check.check_sensors();
  check.check_silence();
  check.check_health();
  check.check_screening();
  check.check_topics();
  check.check_shard();
  check.check_ros2();
  check.check_qos();
  check.check_network(directory);
  check.check_calibrations(directory);
  check.check_state_file(directory);
  check.check_published_file(directory);
  check.check_monitor();
}

}  // namespace gyrod::settings
