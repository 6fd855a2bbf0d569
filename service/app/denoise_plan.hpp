/// What `gyrod denoise` is to do: the configuration with the command line's choices on top.
#pragma once

#include <string>

#include "app/offline_denoiser.hpp"
#include "core/denoise/denoiser.hpp"
#include "settings/settings.hpp"

namespace gyrod::app {

/// As the user wrote it. Empty: as configured.
struct DenoiseChoice {
  std::string config;
  std::string method;
  std::string scheme;     ///< this and the next three concern method paper, and imply it
  std::string screening;  ///< of a whole record, where nothing is configured either: the paper's
  bool batch = false;
  std::string models;  ///< of a whole record; empty: identified
  std::string estimate = "denoised";
  std::string noise;   ///< a calibration for this recording
  std::string sensor;  ///< whose recording it is
};

struct DenoisePlan {
  settings::Settings settings;
  bool whole_record = false;
  core::DenoiserOptions options;  ///< of a whole record
  OfflineChoice offline;          ///< of windows
};

/// @throws settings::SettingsError, CLI::ValidationError for choices that exclude one another, settings::NoiseFileError for a calibration
/// that cannot be used
[[nodiscard]] DenoisePlan plan_of(const DenoiseChoice& choice);

}  // namespace gyrod::app
