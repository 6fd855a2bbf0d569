#include "core/inertial/attitude.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gyrod::core {
namespace {

constexpr double kSmall_rad = 1e-4;  // below it two terms of the series are exact to 1e-17

}  // namespace

Eigen::Quaterniond attitude_of(const EulerAngles& angles) noexcept {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angles.heading_rad, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(angles.pitch_rad, Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(angles.roll_rad, Eigen::Vector3d::UnitX()));
}

EulerAngles euler_of(const Eigen::Quaterniond& attitude) noexcept {
  const Eigen::Matrix3d c = attitude.toRotationMatrix();
  return {std::atan2(c(2, 1), c(2, 2)), std::atan2(-c(2, 0), std::hypot(c(2, 1), c(2, 2))),
          std::atan2(c(1, 0), c(0, 0))};
}

Eigen::Quaterniond quaternion_of(const Eigen::Vector3d& rotation_rad) noexcept {
  const double angle = rotation_rad.norm();
  const double half_sinc = angle < kSmall_rad ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  Eigen::Quaterniond quaternion;
  quaternion.w() = std::cos(0.5 * angle);
  quaternion.vec() = half_sinc * rotation_rad;
  return quaternion;
}

Eigen::Vector3d rotation_of(const Eigen::Quaterniond& quaternion) noexcept {
  // q and -q are one rotation; the one with w >= 0 turns by pi at most.
  const double sign = quaternion.w() < 0.0 ? -1.0 : 1.0;
  const double sine = quaternion.vec().norm();
  const double cosine = sign * quaternion.w();
  const double angle = 2.0 * std::atan2(sine, cosine);
  const double scale =
      sine < kSmall_rad ? 2.0 / cosine * (1.0 - sine * sine / (3.0 * cosine * cosine)) : angle / sine;
  return sign * scale * quaternion.vec();
}

double wrapped(double angle_rad) noexcept { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

}  // namespace gyrod::core
