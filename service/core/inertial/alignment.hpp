/// Attitude and sensor errors from a stretch at rest.
///
/// Source: [Groves] Groves 2013, section 5.6.2. Pure, allocates nothing, safe to call from any thread.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/inertial/earth.hpp"

namespace gyrod::core {

/// Constant errors of a sensor in body axes: measured = true + bias.
struct SensorBias {
  Eigen::Vector3d gyro_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_mps2 = Eigen::Vector3d::Zero();
};

/// Attitude of a body at rest from its mean specific force f (which points up) and a known heading:
///   roll = atan2(-f_y, -f_z),  pitch = atan2(f_x, (f_y^2 + f_z^2)^(1/2)).         [Groves] eq. (5.101)
/// Off by the accelerometer's horizontal error / g rad.
/// @pre specific_force_mps2 is not zero
[[nodiscard]] Eigen::Quaterniond levelled(const Eigen::Vector3d& specific_force_mps2,
                                          double heading_rad) noexcept;

/// What a sensor at rest measures beyond earth rate and gravity:
///   gyro  = mean rate - C' w_ie,    accel = mean f - C' (0, 0, -g).
/// After levelled() on the same mean the accelerometer's part is the one along gravity.
/// @param attitude body to NED
[[nodiscard]] SensorBias bias_at_rest(const Eigen::Vector3d& mean_rate_radps,
                                      const Eigen::Vector3d& mean_specific_force_mps2,
                                      const Eigen::Quaterniond& attitude,
                                      const GeodeticPosition& position) noexcept;

}  // namespace gyrod::core
