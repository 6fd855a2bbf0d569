/// From a recording to a noise calibration, and the table that says how.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "core/noise/still_noise.hpp"
#include "core/noise/still_search.hpp"
#include "files/record.hpp"
#include "settings/noise_calibration.hpp"

namespace gyrod::app {

struct CalibrationOptions {
  /// The user's word that the recording is still throughout: nothing is looked for.
  bool all_still = false;
  double from_s = 0.0;  ///< of the recording
  double to_s = 1e300;
  double least_still_s = 30.0;
  std::string sensor_id;  ///< empty: for all sensors
};

struct NoiseCalibrationRun {
  settings::NoiseCalibration calibration;
  core::StillSearch found;
  std::array<core::StillAxis, 3> axes;
  double first_s = 0.0;     ///< where the part that was looked at begins, s into the recording
  std::size_t samples = 0;  ///< of it
  bool with_accelerometer = false;
  std::string accelerometer_trouble;  ///< why one that is there is not used; empty where there is none
  bool any_bridged = false;
};

/// Finds where the recording is still, and fits the noise of each axis there.
/// @param go_on called now and then with the part that is done; false stops
/// @throws files::FileError where less is still than options.least_still_s or core::kMinStillSamples (says how much, where, and what the
/// rest is), where no axis changes, and where from and to leave nothing
/// @throws files::Stopped
[[nodiscard]] NoiseCalibrationRun calibrate_noise(const files::Record& record,
                                                  const CalibrationOptions& options,
                                                  const std::function<bool(double done)>& go_on);

/// The figures of each axis in deg/s and the units of data sheets.
[[nodiscard]] std::string calibration_table(const settings::NoiseCalibration& calibration);

/// Lines that two axes share, and which are not in the models; for people. Empty where there are none.
[[nodiscard]] std::string shared_lines_text(const NoiseCalibrationRun& run);

/// What was still and what was not, for people.
[[nodiscard]] std::string stretches_text(const NoiseCalibrationRun& run);

}  // namespace gyrod::app
