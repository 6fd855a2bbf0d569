#include "app/calibration_choice.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "app/offline_denoiser.hpp"
#include "core/noise/noise_units.hpp"
#include "report/json.hpp"

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

std::string other_rate_note(const settings::NoiseCalibration& calibration, double sample_rate_hz) {
  const auto model = std::ranges::find_if(calibration.models, core::is_usable);
  if (model == calibration.models.end()) return "";
  if (core::at_rate(*model, calibration.sample_rate_hz, sample_rate_hz) == *model) return "";
  return "holds for " + report::number_text(calibration.sample_rate_hz) + " Hz; at " +
         report::number_text(sample_rate_hz) + " Hz only its mean density is kept, as white noise";
}

}  // namespace gyrod::app
