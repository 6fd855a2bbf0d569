/// How far a navigation solution is from the truth, and figures of that over many samples.
///
/// Allocates nothing; the functions are pure; an accumulator belongs to one thread at a time.
#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

#include "core/inertial/strapdown.hpp"

namespace gyrod::core {

/// Solution minus truth. NaN in what the truth does not know.
struct TrajectoryError {
  /// Roll, pitch, heading: differences of Euler angles, wrapped to [-180, 180]. What the tables of [Yang2019]
  /// hold. Near pitch +-90 deg roll and heading errors grow without bound though the attitude is good.
  Eigen::Vector3d euler_deg;
  /// Rotation vector about north, east, down that turns the true into the solution's attitude:
  /// log(q q_true^-1). Has no such place; the length is the angle between the two attitudes.
  Eigen::Vector3d rotation_deg;
  Eigen::Vector3d velocity_mps;  ///< north, east, down
  Eigen::Vector3d position_m;    ///< north ("latitude"), east ("longitude"), down, in metres
};

[[nodiscard]] TrajectoryError error_of(const NavigationState& solution,
                                       const NavigationState& truth) noexcept;

struct ErrorStatistics {
  std::uint64_t count = 0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< about the mean, divided by count
  double rmse = 0.0;                ///< (mean of squares)^(1/2): rmse^2 = mean^2 + standard_deviation^2
  double max_abs = 0.0;
};

/// One error, one value at a time (Welford 1962 for mean and standard deviation). NaN is left out.
class ErrorAccumulator {
 public:
  void add(double value) noexcept;
  /// All zero where nothing was added.
  [[nodiscard]] ErrorStatistics statistics() const noexcept;

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of (value - mean)^2
  double max_abs_ = 0.0;
};

/// Figures of every component of a TrajectoryError.
struct TrajectoryStatistics {
  std::array<ErrorStatistics, 3> euler_deg;     ///< roll, pitch, heading
  std::array<ErrorStatistics, 3> rotation_deg;  ///< about north, east, down
  ErrorStatistics total_rotation_deg;           ///< angle between the attitudes
  std::array<ErrorStatistics, 3> velocity_mps;  ///< north, east, down
  std::array<ErrorStatistics, 3> position_m;    ///< north, east, down
  ErrorStatistics horizontal_m;                 ///< distance north-east
};

class TrajectoryAccumulator {
 public:
  void add(const TrajectoryError& error) noexcept;
  [[nodiscard]] TrajectoryStatistics statistics() const noexcept;

 private:
  using Triple = std::array<ErrorAccumulator, 3>;

  Triple euler_;
  Triple rotation_;
  ErrorAccumulator total_;
  Triple velocity_;
  Triple position_;
  ErrorAccumulator horizontal_;
};

}  // namespace gyrod::core
