/// What a recording holds for navigation beside the angular rate: accelerometer and a reference trajectory.
///
///     accel_x_UNIT, accel_y_UNIT, accel_z_UNIT  specific force, UNIT: mps2, g, mg (1 g = 9.80665 m/s^2)
///     Pq_w, Pq_x, Pq_y, Pq_z                    attitude, body to a level frame with z up
///     Proll_deg, Ppitch_deg, Pheading_deg|yaw_deg   attitude, body to NED
///     Plat_deg, Plon_deg, Ph_m                  position on WGS-84
///     Pp_x_m | Ppos_x_m, ..y.., ..z..           position in the level frame with z up
///     Pvn_mps, Pve_mps, Pvd_mps|vu_mps          velocity north, east, down or up
///
/// P is any prefix that ends in "_", the same for all columns of one reference, or nothing. A column set counts
/// only if it is there in full. The level frame's x axis is taken as north.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/inertial/earth.hpp"
#include "core/inertial/truth.hpp"
#include "files/record.hpp"

namespace gyrod::files {

struct Accelerometer {
  std::array<std::vector<double>, 3> specific_force_mps2;  ///< finite, one value a sample of the record
  /// Samples whose cell was no number, made by a straight line between their neighbours (the first and the last
  /// good one hold at the ends).
  std::size_t bridged = 0;
};

/// Longest run of missing accelerometer samples that is bridged.
inline constexpr std::size_t kMostBridgedAccelSamples = 16;

/// @throws FileError if an axis has no column (names what is expected and what there is), if axes differ in unit,
/// or where more than kMostBridgedAccelSamples in a row are no numbers (names the first's time)
[[nodiscard]] Accelerometer accelerometer_of(const Record& record);

/// A reference trajectory and how it was read.
struct NavigationTruth {
  core::Truth truth;   ///< times on the record's axis (Record::time_s)
  std::string source;  ///< prefix or file, for messages
  /// Position is in a level frame, put at the reference position; headings are against its x axis.
  bool local = false;
  /// Velocity is not measured but differences of positions.
  bool velocity_differentiated = false;
  /// Rows left out since they repeat the one before: the reference is slower than the recording.
  std::size_t held = 0;
  /// Between elements further apart than this nothing is interpolated or differentiated, s: ten times their mean
  /// distance, within kShortestTruthGap_s and kLongestTruthGap_s.
  double max_gap_s = 0.0;
};

/// Half width of the differences that make a velocity of positions, s; see core::differentiated().
inline constexpr double kVelocityHalfWidth_s = 0.02;
inline constexpr double kShortestTruthGap_s = 0.1;
inline constexpr double kLongestTruthGap_s = 3.0;

/// The reference in the record's own columns.
/// @param prefix    of its columns; nothing: the only one there is
/// @param reference where a level frame's origin is
/// @return nothing if no prefix is asked for and there is no reference
/// A reference with positions only, most of which repeat the row before, is one that is slower than the recording:
/// only the first row of each repetition counts.
/// @throws FileError if there is none with this prefix (names those found), or several and none is asked for
[[nodiscard]] std::optional<NavigationTruth> truth_columns(const Record& record,
                                                           const std::optional<std::string>& prefix,
                                                           const core::GeodeticPosition& reference);

struct TruthFileOptions {
  /// Time on the record's axis = stamp - Record::first_stamp_s + offset_s.
  double offset_s = 0.0;
  core::GeodeticPosition reference;  ///< where a level frame's origin is
};

/// A reference in a file of its own (CSV, plain or gzip) with its own time column (stamp_T, timestamp_T, time_T;
/// T = ns us ms s) and one column set as above, prefix or not.
/// @throws FileError as LineReader does; for no time column, no or several references, a broken row, times that
/// do not rise, no overlap with the record
[[nodiscard]] NavigationTruth load_truth(const std::string& path, const Record& record,
                                         const TruthFileOptions& options);

}  // namespace gyrod::files
