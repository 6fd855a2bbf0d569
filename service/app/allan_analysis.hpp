/// The Allan analysis of one recording: what `gyrod allan` computes and its outputs show.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/allan/allan_deviation.hpp"
#include "core/allan/noise_coefficients.hpp"
#include "files/record.hpp"

namespace gyrod::app {

enum class SensorKind { kGyro, kAccelerometer };

/// One axis of one sensor. Deviations and coefficients are in SI units: rad/s or m/s^2.
struct AllanChannel {
  SensorKind sensor = SensorKind::kGyro;
  char axis = 'x';
  double mean = 0.0;
  std::vector<core::AllanPoint> points;
  core::NoiseCoefficients fit;  ///< the primary one
  core::NoiseCoefficients slopes;
  core::NoiseCoefficients polynomial;

  /// "gyro_x", "accel_z".
  [[nodiscard]] std::string name() const;
};

struct AllanAnalysis {
  std::string input;
  double sample_rate_hz = 0.0;
  bool rate_given = false;
  std::size_t samples = 0;
  files::Record::Counts rows;
  core::AllanOptions options;
  std::vector<AllanChannel> channels;  ///< gyros, then accelerometers; all with the same cluster times
  std::vector<std::string> notes;      ///< what was left out or filled in, in words
};

/// Analyses the chosen gyro axes, and the accelerometers of the same axes where the record has columns
/// accel_x_mps2, accel_x_g or accel_x_mg and so on. Single missing accelerometer cells are bridged by a straight
/// line, up to `max_bridged_samples` in a row; a channel with more of them is left out with a note.
/// @param axes  some of "xyz"
/// @param go_on called before each channel with the part that is done; false ends it early, with the channels
///              analysed so far
/// @throws files::FileError if the record has not one of the gyro axes, or is too short: fewer than 3 samples
[[nodiscard]] AllanAnalysis analyse_allan(const files::Record& record, std::string_view axes,
                                          const core::AllanOptions& options,
                                          const std::function<bool(double)>& go_on);

}  // namespace gyrod::app
