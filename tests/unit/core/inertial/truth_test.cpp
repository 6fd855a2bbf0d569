// Reference trajectories: between samples, across gaps, differentiated, turned into NED.
#include "core/inertial/truth.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/inertial/attitude.hpp"

namespace gyrod::core {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Truth velocities(std::vector<double> times, const std::vector<double>& north) {
  Truth truth;
  truth.time_s = std::move(times);
  for (const double v : north) truth.velocity_mps.emplace_back(v, 0.0, 0.0);
  return truth;
}

TEST(Truth, IsInterpolatedBetweenNeighboursAndNeverExtrapolated) {
  const Truth truth = velocities({1.0, 2.0, 5.0}, {10.0, 20.0, 30.0});
  EXPECT_DOUBLE_EQ(truth_at(truth, 1.25, 1.0).velocity_mps.x(), 12.5);
  EXPECT_DOUBLE_EQ(truth_at(truth, 1.0, 1.0).velocity_mps.x(), 10.0);
  EXPECT_DOUBLE_EQ(truth_at(truth, 5.0, 1.0).velocity_mps.x(), 30.0);
  EXPECT_FALSE(is_known(truth_at(truth, 0.999, 1.0).velocity_mps));
  EXPECT_FALSE(is_known(truth_at(truth, 5.001, 1.0).velocity_mps));
  EXPECT_FALSE(is_known(truth_at(truth, 3.0, 1.0).velocity_mps)) << "gap of 3 s";
  EXPECT_FALSE(is_known(truth_at(truth, 1.5, 1.0).attitude)) << "has none";
}

TEST(Truth, NextToALostSampleIsUnknown) {
  const Truth truth = velocities({1.0, 2.0, 3.0, 4.0}, {10.0, kNan, 30.0, 40.0});
  EXPECT_FALSE(is_known(truth_at(truth, 2.5, 1.0).velocity_mps));
  EXPECT_TRUE(is_known(truth_at(truth, 3.5, 1.0).velocity_mps));
}

// Of a parabola it is exact; 1 m/s^2 north from 0.
TEST(Truth, VelocityIsTheSlopeOfPosition) {
  std::vector<double> times;
  std::vector<GeodeticPosition> places;
  for (int n = 0; n <= 100; ++n) {
    const double t = 0.01 * n;
    times.push_back(t);
    places.push_back(moved({0.5, 0.5, 10.0}, {0.5 * t * t, 2.0 * t, -3.0 * t}));
  }
  places[50].height_m = kNan;
  const auto velocity = differentiated(times, places, 0.02, 0.1);
  ASSERT_EQ(velocity.size(), times.size());
  EXPECT_FALSE(is_known(velocity[1])) << "no neighbour 20 ms before";
  EXPECT_FALSE(is_known(velocity[50])) << "lost itself";
  EXPECT_TRUE(is_known(velocity[48])) << "takes the next neighbour but one";
  // 1e-16 of 6.4e6 m over 40 ms
  EXPECT_LT((velocity[30] - Eigen::Vector3d(0.3, 2.0, -3.0)).norm(), 1e-6);
}

TEST(Truth, IsNotDifferentiatedAcrossALongGap) {
  const std::vector<double> times = {0.0, 0.1, 0.2, 2.0, 2.1};
  const std::vector<GeodeticPosition> places(5);
  const auto velocity = differentiated(times, places, 0.02, 0.5);
  EXPECT_TRUE(is_known(velocity[1]));
  EXPECT_FALSE(is_known(velocity[2]));
  EXPECT_FALSE(is_known(velocity[3]));
}

// A body whose axes are the z-up frame's: its z axis points up, that is NED -z.
TEST(Truth, AttitudesAgainstZUpBecomeAttitudesAgainstNed) {
  const Eigen::Quaterniond q = ned_from_z_up(Eigen::Quaterniond::Identity());
  EXPECT_LT((q * Eigen::Vector3d::UnitZ() + Eigen::Vector3d::UnitZ()).norm(), 1e-15);
  EXPECT_LT((q * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX()).norm(), 1e-15);
  // Turned to the left (anticlockwise from above) by 0.3 rad: heading -0.3.
  EXPECT_NEAR(euler_of(ned_from_z_up(quaternion_of({0.0, 0.0, 0.3}))).heading_rad, -0.3, 1e-15);
  EXPECT_EQ(ned_from_z_up(Eigen::Vector3d(1.0, 2.0, 3.0)), Eigen::Vector3d(1.0, -2.0, -3.0));
}

}  // namespace
}  // namespace gyrod::core
