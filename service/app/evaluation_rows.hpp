/// The rows of an evaluation: for each axis and each scale of the noise what is true and what an estimator is given.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/evaluation_noise.hpp"
#include "app/sensor_axes.hpp"
#include "files/record.hpp"

namespace gyrod::app {

/// Where truth and noise come from.
struct EvaluationInput {
  std::string recording;
  std::optional<double> rate_hz;  ///< of the recording and of the noise, whatever their stamps say
  /// Beginning of the truth's column names, PREFIXx_UNIT; nothing: truth_ or ref_gyro_.
  std::optional<std::string> truth_prefix;
  /// Which column is the truth of the sensor's x, y, z, each with an optional minus.
  std::array<std::string, 3> truth_axes = {"x", "y", "z"};
  /// The recording's own rates are the truth; needs noise.
  bool signal_is_truth = false;
  /// A still recording whose noise is added to the truth; empty: the recording's own rates are what estimators are given.
  std::string noise;
  std::array<std::string, 3> noise_axes = {"x", "y", "z"};
  std::size_t noise_start = 0;
  std::vector<double> noise_scales = {1.0};
  /// What is known of the sensor whose noise it is: the one that the noise recording is of, where there is one.
  NoiseKnowledge known;
  /// End of the signal band: what of the truth lies above is not asked for. 0: all is.
  double max_signal_hz = 0.0;
  std::vector<std::string> axes = {"x", "y", "z"};
  bool skip_broken_rows = false;
  /// Of both files, as in files::RecordOptions.
  double max_rate_radps = 175.0;
  std::uint64_t max_bridged_samples = 16;
  /// As files::RecordOptions::progress.
  std::function<bool(std::optional<double>, std::uint64_t)> progress;
};

/// All series are equally long.
struct EvaluationRow {
  std::string axis;
  double noise_scale = 1.0;
  std::vector<double> truth_dps;  ///< within the signal band; NaN where it is not known
  std::vector<double> noisy_dps;  ///< finite
  std::vector<double>
      noise_dps;  ///< finite, mean 0: what is added, or measured minus true at all frequencies, where the truth is lost by straight lines
  RowNoise noise;  ///< what methods that take a model of it are told
  /// All that the sensor measures, what it is told in `noise` included; null where the noise is known, or shared by its axes.
  std::shared_ptr<const SensorAxes> sensor;
};

struct EvaluationRows {
  std::string name;           ///< of the recording
  std::string noise_name;     ///< empty: none was added
  std::string truth_columns;  ///< "ref_gyro_", or "gyro" where the signal is the truth
  bool signal_is_truth = false;
  std::vector<std::string> axes;          ///< judged
  std::array<std::string, 3> truth_axes;  ///< of x, y, z
  std::array<std::string, 3> noise_axes;
  settings::NoiseSource noise_source = settings::NoiseSource::kAuto;
  std::string calibration_file;   ///< empty: none is used
  std::size_t noise_start = 0;    ///< first sample that is added
  std::size_t spare_samples = 0;  ///< of the noise, that are not added
  double rate_hz = 0.0;
  std::size_t samples = 0;
  bool judged_alone =
      false;  ///< axes are not compared, as they are given the same noise, where that is not known in full
  std::vector<EvaluationRow> rows;  ///< all axes of the first scale, then of the next
  std::vector<std::string> cautions;
};

/// What is left out, bridged, repeated or assumed stands in the cautions.
/// @throws CLI::ValidationError for a noise_start beyond the noise's end
/// @throws files::FileError for no truth, rates that differ, an axis that a file does not have, less than 100 samples, a truth without a
/// number
/// @throws files::Stopped
[[nodiscard]] EvaluationRows evaluation_rows(const EvaluationInput& input);

}  // namespace gyrod::app
