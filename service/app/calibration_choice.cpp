#include "app/calibration_choice.hpp"

#include <CLI/CLI.hpp>

#include "app/offline_denoiser.hpp"

namespace gyrod::app {

ChosenCalibration choose_calibration(const std::string& flag, const std::string& file,
                                     const std::string& sensor) {
  const auto calibrations = settings::load_calibrations(file);
  ChosenCalibration chosen{sensor.empty() ? OfflineChoice{}.sensor : sensor, {}};
  const bool only = calibrations.size() == 1 && calibrations.front().sensor_id;
  if (only && sensor.empty()) chosen.sensor = *calibrations.front().sensor_id;
  const settings::NoiseCalibration* found = settings::calibration_for(calibrations, chosen.sensor);
  if (found == nullptr) {
    throw CLI::ValidationError(flag,
                               file + " has no calibration for sensor '" + chosen.sensor + "'; see --sensor");
  }
  chosen.calibration = *found;
  return chosen;
}

}  // namespace gyrod::app
