/// Strapdown navigation with several versions of the same angular rates, against the truth: the paper's section
/// on inertial navigation, [Yang2019] tables 7 to 9 and figures 11 to 13.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/inertial/alignment.hpp"
#include "core/inertial/earth.hpp"
#include "core/inertial/trajectory_error.hpp"
#include "files/navigation_columns.hpp"
#include "files/record.hpp"

namespace gyrod::app {

/// One version of the rates: a row of the tables.
struct NavigationRun {
  std::string name;
  /// One value a sample of the record on each axis; they have to live while the comparison runs.
  std::array<std::span<const double>, 3> gyro_radps;
  /// Samples by which the rates come late: 0 puts every rate at its own stamp (lag-compensated), the filter's lag
  /// uses it as one who takes it for current does.
  std::size_t delay_samples = 0;
};

/// Where the sensor's constant errors come from, which are taken off before navigating: for every run from its
/// own rates, in the same way.
enum class BiasSource {
  kAutomatic,  ///< kTruth where the truth has attitudes, else kLevelling
  kLevelling,  ///< the stretch at rest before each start: mean rate less earth rate; mean specific force less g
  kTruth,      ///< one constant an axis that fits the whole record's truth best (core::calibrated_on_truth)
  kNone,
};

struct NavigationOptions {
  /// On the record's axis, s. Empty: start_count of them, spread evenly over the times where one is possible.
  std::vector<double> starts_s;
  std::size_t start_count = 5;
  double duration_s = 50.0;  ///< [Yang2019] section 3.3
  /// Stretch at rest before each start that roll and pitch (and biases) come from, where they are wanted.
  double level_s = 10.0;
  BiasSource bias = BiasSource::kAutomatic;
  /// Of the body's x axis at each start, where the truth has no attitude. Nothing: found by matching velocity
  /// changes with the truth's where that has a velocity, else 0.
  std::optional<double> heading_deg;
  /// Where the record was made, if the truth does not say.
  core::GeodeticPosition reference;
  /// Keep the errors sample by sample.
  bool keep_series = false;
};

/// One sample of the errors.
struct NavigationErrorSample {
  double time_s = 0.0;  ///< since the start
  core::TrajectoryError error;
};

struct NavigationStart {
  double time_s = 0.0;       ///< on the record's axis
  std::size_t compared = 0;  ///< truth samples within the duration that are known in some part
  std::size_t lost = 0;      ///< truth samples within the duration that are not known: gaps, skipped
  double heading_deg = 0.0;  ///< of the body's x axis at the start
};

struct NavigationRunResult {
  std::string name;
  std::size_t delay_samples = 0;
  core::TrajectoryStatistics pooled;                       ///< over all samples of all starts
  std::vector<core::TrajectoryStatistics> per_start;       ///< in the order of NavigationResult::starts
  std::vector<core::SensorBias> bias;                      ///< taken off, one a start
  std::vector<std::vector<NavigationErrorSample>> series;  ///< one a start; empty unless keep_series
};

struct NavigationResult {
  double duration_s = 0.0;
  std::vector<NavigationStart> starts;
  std::vector<NavigationRunResult> runs;  ///< in the order they were given
  bool has_attitude = false;  ///< the truth knows it, so that the attitude's figures mean something
  bool has_velocity = false;
  bool has_position = false;
  bool local_frame = false;  ///< "north" is the x axis of the truth's own level frame
  /// What was assumed, in sentences: where start state, biases, latitude and truth come from.
  std::vector<std::string> notes;
};

/// Navigates every run from every start and compares with the truth at the truth's own times.
/// Start: at the first sample at or after the time asked for where the truth is known. Attitude from the truth;
/// where that has none, levelled on the level_s before. Velocity and position from the truth.
/// @param truth the reference; nothing: the record is at rest (velocity 0, position and attitude as at the start)
/// @throws files::FileError if the record is shorter than needed, a run is not as long as the record, or no start
/// is possible (says why); CLI::ValidationError if one of starts_s lies outside
[[nodiscard]] NavigationResult compare_navigation(const files::Record& record,
                                                  const files::Accelerometer& accelerometer,
                                                  const std::vector<NavigationRun>& runs,
                                                  const std::optional<files::NavigationTruth>& truth,
                                                  const NavigationOptions& options);

}  // namespace gyrod::app
