// Attitudes: definitions, inverses, and the places where formulas break.
#include "core/inertial/attitude.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(Attitude, EulerAnglesMeanWhatTheHeaderSays) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  // Heading 90 deg: the nose points east; pitch 90 deg: up; roll 90 deg: the right wing (y) points down.
  EXPECT_LT((attitude_of({0.0, 0.0, kPi / 2}) * forward - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((attitude_of({0.0, kPi / 2, 0.0}) * forward + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((attitude_of({kPi / 2, 0.0, 0.0}) * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(),
            1e-15);
}

TEST(Attitude, EulerAnglesComeBack) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-3.1, 3.1);
  std::uniform_real_distribution<double> half(-1.5, 1.5);
  for (int n = 0; n < 1000; ++n) {
    const EulerAngles angles{any(random), half(random), any(random)};
    const EulerAngles back = euler_of(attitude_of(angles));
    // Roll and heading lose 1/cos(pitch), 14 at 1.5 rad, of a double's 16 digits.
    ASSERT_NEAR(back.roll_rad, angles.roll_rad, 1e-13);
    ASSERT_NEAR(back.pitch_rad, angles.pitch_rad, 1e-13);
    ASSERT_NEAR(back.heading_rad, angles.heading_rad, 1e-13);
  }
}

TEST(Attitude, RotationVectorsComeBackFromNoneToHalfATurn) {
  for (const double angle : {0.0, 1e-300, 1e-12, 1e-6, 0.99e-4, 1.01e-4, 1e-3, 1.0, 3.0, kPi - 1e-9}) {
    const Eigen::Vector3d rotation = angle * Eigen::Vector3d(2.0, -3.0, 6.0) / 7.0;
    const Eigen::Quaterniond q = quaternion_of(rotation);
    EXPECT_NEAR(q.norm(), 1.0, 1e-15) << angle;
    EXPECT_LE((rotation_of(q) - rotation).norm(), 1e-14 * angle + 1e-300) << angle;
    const Eigen::Quaterniond same(-q.w(), -q.x(), -q.y(), -q.z());
    EXPECT_LE((rotation_of(same) - rotation).norm(), 1e-14 * angle + 1e-300) << angle;
  }
}

TEST(Attitude, RotationVectorIsAxisTimesAngle) {
  const Eigen::Quaterniond q = quaternion_of({0.0, 0.0, kPi / 2});
  EXPECT_LT((q * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Attitude, WrapsToHalfATurnEitherWay) {
  EXPECT_NEAR(wrapped(2.0 * kPi + 0.1), 0.1, 1e-15);
  EXPECT_NEAR(wrapped(-kPi - 0.1), kPi - 0.1, 1e-15);
  EXPECT_EQ(wrapped(3.0), 3.0);
}

}  // namespace
}  // namespace gyrod::core
