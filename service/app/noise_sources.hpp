/// What is known of the sensors' noise, beforehand and while the engine runs.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "settings/noise_calibration.hpp"
#include "settings/noise_state.hpp"
#include "settings/settings.hpp"
#include "stream/engine.hpp"
#include "stream/standstill_noise.hpp"

namespace gyrod::app {

/// By noise.source: `calibrated` a sensor's calibration, `standstill` what was learned at rest, `auto` the first of these that there is,
/// `imf1` nothing. All but `imf1` learn, whatever is in use, so that the report tells rest and the state file fills.
class NoiseSources {
 public:
  /// Reads the calibrations that the settings name.
  /// @param remembered of an earlier run
  /// @throws settings::NoiseFileError
  NoiseSources(const settings::NoiseSettings& settings, settings::NoiseStates remembered);

  /// Has an engine's channels use this. It has to outlive the engine.
  /// @param in_motion whether the method asks for what is learned in motion
  void attach_to(stream::EngineOptions& options, bool in_motion);

  /// What was learned by now or is remembered, of all sensors of which something was; not all of one moment, as the thread that learns is
  /// let in between. Any thread.
  [[nodiscard]] settings::NoiseStates learned() const;
  /// Rises with every change of learned(). Any thread.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

  /// A sensor's; nullptr where it has none, or where noise.source does not ask for it.
  [[nodiscard]] const settings::NoiseCalibration* calibration_of(std::string_view sensor) const {
    return settings::calibration_for(calibrations_, sensor);
  }
  [[nodiscard]] std::size_t calibrations() const noexcept { return calibrations_.size(); }
  [[nodiscard]] std::size_t remembered() const noexcept { return remembered_; }

 private:
  /// Of a channel, made when it opens, so that learning allocates nothing: the sensor's entry until something is learned of it. Goes with
  /// the channel.
  struct Place {
    settings::NoiseStates::node_type entry;    ///< not in learned_ yet, if ever
    stream::RememberedNoise* state = nullptr;  ///< in learned_
  };

  [[nodiscard]] stream::StandstillOptions options_of(std::string_view sensor, double sample_rate_hz) const;
  [[nodiscard]] std::unique_ptr<stream::NoiseLearner> learner_of(std::string_view sensor,
                                                                 double sample_rate_hz, bool in_motion);
  void keep(Place& place, const stream::RememberedNoise& state);

  settings::NoiseSource source_;
  std::vector<settings::NoiseCalibration> calibrations_;
  std::size_t remembered_;  ///< sensors, of an earlier run
  mutable std::mutex mutex_;
  settings::NoiseStates learned_;  ///< only grows, by sensors of which something was learned or is remembered
  std::atomic<std::uint64_t> revision_{0};
};

/// For a command that works on files: what the settings' state file holds; it is read and never written.
/// @throws settings::NoiseFileError where it is damaged, files::FileError where it cannot be read
[[nodiscard]] settings::NoiseStates remembered_noise(const settings::NoiseSettings& settings);

}  // namespace gyrod::app
