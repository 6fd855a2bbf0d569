/// The calibration that a command line names for one recording.
#pragma once

#include <string>

#include "settings/noise_calibration.hpp"

namespace gyrod::app {

struct ChosenCalibration {
  std::string sensor;  ///< whose recording it is then
  settings::NoiseCalibration calibration;
};

/// @param flag that named the file, for messages
/// @param file of `gyrod calibrate`, or a folder of them
/// @param sensor empty: the sensor of the only calibration there is, else that of OfflineChoice
/// @throws settings::NoiseFileError for a file that cannot be used, CLI::ValidationError where it has none for the sensor
[[nodiscard]] ChosenCalibration choose_calibration(const std::string& flag, const std::string& file,
                                                   const std::string& sensor);

/// "holds for 120 Hz; ...": that a sample rate is another one than a calibration's, and what that costs. Empty where it costs nothing.
[[nodiscard]] std::string other_rate_note(const settings::NoiseCalibration& calibration,
                                          double sample_rate_hz);

}  // namespace gyrod::app
