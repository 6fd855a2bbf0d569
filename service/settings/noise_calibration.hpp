/// Noise calibrations: a sensor's own noise, measured beforehand by `gyrod calibrate` or taken from its data sheet.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/noise/noise_model.hpp"
#include "settings/json_fields.hpp"

namespace gyrod::settings {

/// Where the figures come from, for people.
struct NoiseOrigin {
  std::string source;                   ///< the recording's name, or the data sheet's figure
  std::optional<double> first_stamp_s;  ///< of the recording's first sample, on its own clock
  std::optional<double> still_s;        ///< of the recording that was used
};

struct NoiseCalibration {
  std::optional<std::string> sensor_id;  ///< nothing: for every sensor without a calibration of its own
  double sample_rate_hz = 0.0;           ///< that the models hold for; see core::at_rate()
  /// rad/s, as measured, without core::kNoiseMargin. Not usable for an axis that was not there; one at least is.
  std::array<core::NoiseModel, 3> models{};
  std::array<double, 3> bias_radps{};  ///< mean while still; 0 from a data sheet
  NoiseOrigin origin;
};

/// JSON, version 1: docs/noise.md describes it. The models in rad/s, and beside them `figures` in the units of data sheets.
[[nodiscard]] std::string calibration_text(const NoiseCalibration& calibration);

/// @param file for messages
/// @throws NoiseFileError for anything that does not fit, also for figures that are not those of the models
[[nodiscard]] NoiseCalibration parse_calibration(const std::string& file, std::string_view text);

/// Reads a calibration, or all files *.json of a folder in the order of their names.
/// @throws NoiseFileError for a path that cannot be read, for a file that does not fit, for two files for the same sensor
[[nodiscard]] std::vector<NoiseCalibration> load_calibrations(const std::filesystem::path& file_or_folder);

/// The one for this sensor, else the one for all, else nullptr.
[[nodiscard]] const NoiseCalibration* calibration_for(std::span<const NoiseCalibration> calibrations,
                                                      std::string_view sensor_id) noexcept;

}  // namespace gyrod::settings
