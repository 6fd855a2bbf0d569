// Errors and their figures against values by hand.
#include "core/inertial/trajectory_error.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "core/inertial/attitude.hpp"
#include "core/inertial/truth.hpp"

namespace gyrod::core {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(TrajectoryError, IsSolutionMinusTruth) {
  NavigationState truth{{0.8, 0.3, 100.0}, {1.0, 2.0, 3.0}, attitude_of({0.1, 0.2, 3.1})};
  NavigationState solution = truth;
  solution.attitude = attitude_of({0.11, 0.18, -3.13});  // across the cut at 180 deg
  solution.velocity_mps = {1.5, 2.0, 2.0};
  solution.position = moved(truth.position, {10.0, -20.0, 5.0});
  const TrajectoryError error = error_of(solution, truth);
  EXPECT_NEAR(error.euler_deg.x(), 0.01 / kDegree, 1e-12);
  EXPECT_NEAR(error.euler_deg.y(), -0.02 / kDegree, 1e-12);
  EXPECT_NEAR(error.euler_deg.z(), (2.0 * std::numbers::pi - 6.23) / kDegree, 1e-11);
  EXPECT_LT((error.velocity_mps - Eigen::Vector3d(0.5, 0.0, -1.0)).norm(), 1e-15);
  EXPECT_LT((error.position_m - Eigen::Vector3d(10.0, -20.0, 5.0)).norm(), 1e-8);  // rounding: 1e-16 of 6e6 m
}

TEST(TrajectoryError, RotationIsAboutTheNavigationAxes) {
  NavigationState truth;
  truth.attitude = attitude_of({1.0, -0.5, 2.0});
  NavigationState solution = truth;
  const Eigen::Vector3d small(1e-3, -2e-3, 3e-3);
  solution.attitude = quaternion_of(small) * truth.attitude;
  EXPECT_LT((error_of(solution, truth).rotation_deg * kDegree - small).norm(), 1e-15);
}

TEST(TrajectoryError, OfWhatTheTruthDoesNotKnowIsNotANumber) {
  NavigationState truth = unknown_state();
  truth.velocity_mps.setZero();
  const TrajectoryError error = error_of({}, truth);
  EXPECT_TRUE(std::isnan(error.euler_deg.x()));
  EXPECT_TRUE(std::isnan(error.rotation_deg.z()));
  EXPECT_TRUE(std::isnan(error.position_m.y()));
  EXPECT_EQ(error.velocity_mps.norm(), 0.0);
}

// 1, 2, 3, -6: mean 0, mean square 50/4.
TEST(ErrorAccumulator, GivesMeanDeviationRmseAndMaximum) {
  ErrorAccumulator sums;
  for (const double value : {1.0, 2.0, 3.0, std::numeric_limits<double>::quiet_NaN(), -6.0}) sums.add(value);
  ErrorStatistics figures = sums.statistics();
  EXPECT_EQ(figures.count, 4U);
  EXPECT_NEAR(figures.mean, 0.0, 1e-15);
  EXPECT_NEAR(figures.standard_deviation, std::sqrt(12.5), 1e-15);
  EXPECT_NEAR(figures.rmse, std::sqrt(12.5), 1e-15);
  EXPECT_EQ(figures.max_abs, 6.0);
  // 11, 12, 13, 4: mean 10, the deviation stays, rmse^2 = 100 + 12.5.
  ErrorAccumulator shifted;
  for (const double value : {11.0, 12.0, 13.0, 4.0}) shifted.add(value);
  figures = shifted.statistics();
  EXPECT_NEAR(figures.mean, 10.0, 1e-14);
  EXPECT_NEAR(figures.standard_deviation, std::sqrt(12.5), 1e-14);
  EXPECT_NEAR(figures.rmse, std::sqrt(112.5), 1e-14);
}

TEST(ErrorAccumulator, WithoutValuesIsZero) { EXPECT_EQ(ErrorAccumulator{}.statistics().rmse, 0.0); }

TEST(TrajectoryAccumulator, SortsComponentsAndAddsDistances) {
  TrajectoryAccumulator sums;
  TrajectoryError error;
  error.euler_deg = {1.0, 2.0, 3.0};
  error.rotation_deg = {2.0, 3.0, 6.0};
  error.velocity_mps = {4.0, 5.0, 6.0};
  error.position_m = {3.0, 4.0, 12.0};
  sums.add(error);
  const TrajectoryStatistics figures = sums.statistics();
  EXPECT_EQ(figures.euler_deg[1].mean, 2.0);
  EXPECT_EQ(figures.rotation_deg[0].mean, 2.0);
  EXPECT_EQ(figures.total_rotation_deg.mean, 7.0);
  EXPECT_EQ(figures.velocity_mps[2].mean, 6.0);
  EXPECT_EQ(figures.position_m[0].mean, 3.0);
  EXPECT_EQ(figures.horizontal_m.mean, 5.0);
}

}  // namespace
}  // namespace gyrod::core
