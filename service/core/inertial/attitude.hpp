/// Attitudes as unit quaternions, Euler angles and rotation vectors. An attitude turns vectors from body to NED
/// axes. All functions are pure, allocate nothing and are safe to call from any thread.
///
/// Source: [Groves] Groves 2013, section 2.2; Euler angles in the order heading, pitch, roll (z, y, x).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace gyrod::core {

/// Roll, pitch, heading of the body axes against north, east, down, rad. A body with z down (forward, right,
/// down) that stands level has roll 0; one with z up (forward, left, up) has roll pi.
struct EulerAngles {
  double roll_rad = 0.0;     ///< (-pi, pi]
  double pitch_rad = 0.0;    ///< [-pi/2, pi/2]
  double heading_rad = 0.0;  ///< of the body's x axis, clockwise from north, (-pi, pi]
};

/// Body to NED. [Groves] eq. (2.38)
[[nodiscard]] Eigen::Quaterniond attitude_of(const EulerAngles& angles) noexcept;

/// [Groves] eq. (2.37). At pitch +-pi/2 only roll - heading (or their sum) is defined.
[[nodiscard]] EulerAngles euler_of(const Eigen::Quaterniond& attitude) noexcept;

/// Quaternion of a rotation by |v| rad about v: (cos |v|/2, sin(|v|/2) v/|v|).
[[nodiscard]] Eigen::Quaterniond quaternion_of(const Eigen::Vector3d& rotation_rad) noexcept;

/// Rotation vector of a unit quaternion, |v| <= pi: quaternion_of() turned round.
[[nodiscard]] Eigen::Vector3d rotation_of(const Eigen::Quaterniond& quaternion) noexcept;

/// The same angle in [-pi, pi].
[[nodiscard]] double wrapped(double angle_rad) noexcept;

}  // namespace gyrod::core
