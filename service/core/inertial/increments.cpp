#include "core/inertial/increments.hpp"

#include <Eigen/Geometry>

namespace gyrod::core {

BodyIncrement increment_between(const InertialSample& from, const InertialSample& to, double dt_s) noexcept {
  const Eigen::Vector3d alpha = 0.5 * dt_s * (from.rate_radps + to.rate_radps);
  const Eigen::Vector3d velocity = 0.5 * dt_s * (from.specific_force_mps2 + to.specific_force_mps2);
  const double twelfth = dt_s * dt_s / 12.0;
  return {alpha + twelfth * from.rate_radps.cross(to.rate_radps),
          velocity + 0.5 * alpha.cross(velocity) +
              twelfth * (from.rate_radps.cross(to.specific_force_mps2) +
                         from.specific_force_mps2.cross(to.rate_radps))};
}

BodyIncrement increment_of(const InertialIntegral& before, const InertialIntegral& now) noexcept {
  return {now.angle_rad + before.angle_rad.cross(now.angle_rad) / 12.0,
          now.velocity_mps + 0.5 * now.angle_rad.cross(now.velocity_mps) +
              (before.angle_rad.cross(now.velocity_mps) + before.velocity_mps.cross(now.angle_rad)) / 12.0};
}

}  // namespace gyrod::core
