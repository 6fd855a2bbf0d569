#include "core/inertial/alignment.hpp"

#include <cmath>

#include "core/inertial/attitude.hpp"

namespace gyrod::core {

Eigen::Quaterniond levelled(const Eigen::Vector3d& specific_force_mps2, double heading_rad) noexcept {
  const double x = specific_force_mps2.x();
  const double y = specific_force_mps2.y();
  const double z = specific_force_mps2.z();
  return attitude_of({std::atan2(-y, -z), std::atan2(x, std::hypot(y, z)), heading_rad});
}

SensorBias bias_at_rest(const Eigen::Vector3d& mean_rate_radps,
                        const Eigen::Vector3d& mean_specific_force_mps2, const Eigen::Quaterniond& attitude,
                        const GeodeticPosition& position) noexcept {
  const Eigen::Quaterniond to_body = attitude.conjugate();
  const Eigen::Vector3d lift(0.0, 0.0, -normal_gravity_mps2(position.latitude_rad, position.height_m));
  return {mean_rate_radps - to_body * earth_rate_radps(position.latitude_rad),
          mean_specific_force_mps2 - to_body * lift};
}

}  // namespace gyrod::core
