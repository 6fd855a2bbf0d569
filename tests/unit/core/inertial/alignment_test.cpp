// Levelling: what goes in as gravity comes out as level.
#include "core/inertial/alignment.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "core/inertial/attitude.hpp"

namespace gyrod::core {
namespace {

// Identity: the specific force of rest in this attitude gives the attitude back.
TEST(Alignment, FindsTheAttitudeThatGravityWasMeasuredIn) {
  for (const double roll : {-3.0, -0.4, 0.0, 0.7, 3.14159}) {
    for (const double pitch : {-1.4, 0.0, 0.3}) {
      for (const double heading : {-2.0, 0.0, 1.0}) {
        const Eigen::Quaterniond attitude = attitude_of({roll, pitch, heading});
        const Eigen::Vector3d force = attitude.conjugate() * Eigen::Vector3d(0.0, 0.0, -9.81);
        const Eigen::Quaterniond found = levelled(force, heading);
        EXPECT_LT(rotation_of(found * attitude.conjugate()).norm(), 1e-14);
      }
    }
  }
}

TEST(Alignment, ASensorWithZUpHasRollPi) {
  const EulerAngles angles = euler_of(levelled({0.0, 0.0, 9.81}, 0.5));
  EXPECT_NEAR(std::abs(angles.roll_rad), std::numbers::pi, 1e-15);
  EXPECT_NEAR(angles.heading_rad, 0.5, 1e-15);
}

TEST(Alignment, FindsTheBiasThatWasPutIn) {
  const GeodeticPosition place{0.8, 0.0, 200.0};
  const Eigen::Quaterniond attitude = attitude_of({0.1, -0.2, 2.0});
  const Eigen::Vector3d gyro_bias(0.01, -0.02, 0.03);
  const Eigen::Vector3d accel_bias(0.1, 0.2, -0.3);
  const Eigen::Vector3d rate = attitude.conjugate() * earth_rate_radps(0.8) + gyro_bias;
  const Eigen::Vector3d force =
      attitude.conjugate() * Eigen::Vector3d(0.0, 0.0, -normal_gravity_mps2(0.8, 200.0)) + accel_bias;
  const SensorBias bias = bias_at_rest(rate, force, attitude, place);
  EXPECT_LT((bias.gyro_radps - gyro_bias).norm(), 1e-17);
  EXPECT_LT((bias.accel_mps2 - accel_bias).norm(), 1e-14);
}

// What levelling cannot tell from a tilt is in the attitude; what is left points along gravity.
TEST(Alignment, AfterLevellingTheAccelerometersBiasIsAlongGravity) {
  const Eigen::Vector3d force(0.3, -0.2, -9.9);
  const Eigen::Quaterniond attitude = levelled(force, 0.0);
  const SensorBias bias = bias_at_rest(Eigen::Vector3d::Zero(), force, attitude, {0.8, 0.0, 0.0});
  EXPECT_NEAR(bias.accel_mps2.cross(force).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace gyrod::core
