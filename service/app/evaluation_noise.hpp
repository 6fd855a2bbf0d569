/// What estimators are told of the sensor's noise in an evaluation, by noise.source as in the daemon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/noise_course.hpp"
#include "settings/noise_calibration.hpp"
#include "settings/settings.hpp"

namespace gyrod::app {

/// Where the noise may be known from, before there is a record.
struct NoiseKnowledge {
  settings::NoiseSource source = settings::NoiseSource::kAuto;
  std::string calibration_file;  ///< or folder; empty: no calibration is used
  std::optional<settings::NoiseCalibration> calibration;
};

/// A calibration that the command line names is used whatever noise.source says, as by `gyrod denoise --noise`; one of noise.calibrations where
/// the source is `auto` or `calibrated` and it is the sensor's. The state file of the settings is not read: it tells of other rests.
/// @param calibration, sensor of the command line; empty: none given
/// @throws settings::NoiseFileError for a file that cannot be used, CLI::ValidationError where the command line's has none for the sensor
[[nodiscard]] NoiseKnowledge noise_knowledge(const std::string& calibration, const std::string& sensor,
                                             const settings::NoiseSettings& settings);

/// What tells the noise of a row.
enum class NoiseKnownBy : std::uint8_t {
  kNothing,       ///< estimators guess it
  kCalibration,   ///< a file of `gyrod calibrate`
  kSpareSamples,  ///< those of the noise recording that are not added
  kRest,          ///< stretches of the record that look at rest
  kMotion,        ///< what is faster than the motion, behind a low-pass of the sensor's own
  kLines,         ///< in motion, its lines alone: the rest is guessed
};

struct RowNoise {
  NoiseKnownBy by = NoiseKnownBy::kNothing;
  NoiseCourse course;  ///< deg/s; nothing usable in it where nothing is known
  /// The first sample behind which a window may end whose noise is known; nothing: there is none.
  std::optional<std::size_t> from_sample;
  /// Nothing is known beforehand, and what is learned may be used: in runs that are no part of the record, too.
  bool learns = false;
};

/// The noise of an axis as it is known beforehand: by the calibration, else by the spare samples.
/// @param axis of the sensor whose noise it is, "z" or "-z"
/// @param spare samples of the noise at rest that are not added, deg/s
/// @param scale what the sensor's noise is multiplied by
/// @param rate_hz of the record; a calibration goes through core::at_rate()
[[nodiscard]] RowNoise told_beforehand(const NoiseKnowledge& known, const std::string& axis,
                                       const std::vector<std::span<const double>>& spare, double scale,
                                       double rate_hz);

/// Adds what was learned. Said to be by rest where some of it is. @pre noise.learns
void add_learned(NoiseCourse learned, RowNoise& noise);

/// What a calibration lacks for a record: another sample rate, axes that it does not have.
/// @param axes of the sensor, each "z" or "-z"
[[nodiscard]] std::vector<std::string> calibration_cautions(const NoiseKnowledge& known,
                                                            const std::vector<std::string>& axes,
                                                            double rate_hz);

}  // namespace gyrod::app
