// The mechanisation against motions that are known exactly, and against the textbook's error behaviour.
#include "core/inertial/strapdown.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/inertial/alignment.hpp"
#include "core/inertial/trajectory_error.hpp"
#include "support/allocation_counter.hpp"
#include "support/exact_motion.hpp"
#include "support/slow_build.hpp"

namespace gyrod::core {
namespace {

using testing::ExactMotion;
using testing::ExactWalk;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Largest error on each component over the whole way.
struct Largest {
  Eigen::Vector3d rotation_deg = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();

  void add(const NavigationState& solution, const NavigationState& truth) {
    const TrajectoryError error = error_of(solution, truth);
    rotation_deg = rotation_deg.cwiseMax(error.rotation_deg.cwiseAbs());
    velocity_mps = velocity_mps.cwiseMax(error.velocity_mps.cwiseAbs());
    position_m = position_m.cwiseMax(error.position_m.cwiseAbs());
  }
};

/// Navigates with the exact increments of the motion.
Largest errors_along(const ExactMotion& motion, double dt_s, int steps) {
  ExactWalk walk(motion);
  NavigationState state = walk.state();
  // The interval before the first is not known: one exact step gives it.
  InertialIntegral before = walk.advance(dt_s);
  state = walk.state();
  Largest largest;
  for (int n = 1; n < steps; ++n) {
    const InertialIntegral now = walk.advance(dt_s);
    state = strapdown_step(state, increment_of(before, now), dt_s);
    before = now;
    largest.add(state, walk.state());
  }
  return largest;
}

// Bounds: shared known answers (evaluation.md, after pyins's own test of its mechanisation).
TEST(Strapdown, StaysWhereItIsForAnHourAtRest) {
  ExactMotion rest;
  rest.start = {50.0 * kDegree, 60.0 * kDegree, 100.0};
  rest.euler_rad = {{{.mean = 0.1}, {.mean = -0.2}, {.mean = 1.0}}};
  const Largest largest = errors_along(rest, 0.1, 36'000);
  EXPECT_LT(largest.position_m.head<2>().maxCoeff(), 1e-3);
  EXPECT_LT(largest.position_m.z(), 1e-2);
  EXPECT_LT(largest.velocity_mps.head<2>().maxCoeff(), 1e-6);
  EXPECT_LT(largest.velocity_mps.z(), 1e-5);
  EXPECT_LT(largest.rotation_deg.maxCoeff(), 1e-8);
}

// Bounds: evaluation.md, 1 h of sine velocity, dt 0.01 s, increments.
TEST(Strapdown, FollowsAnHourOfSineVelocity) {
  ExactMotion motion;
  motion.start = {58.0 * kDegree, 56.0 * kDegree, 150.0};
  motion.velocity_mps = {{{.mean = 1.0, .amplitude = 5.0},
                          {.mean = -1.0, .amplitude = 5.0, .phase_rad = 1.0},
                          {.mean = 0.5, .amplitude = 0.5, .phase_rad = 2.0}}};
  motion.euler_rad = {{{.amplitude = 5.0 * kDegree, .period_s = 20.0},
                       {.amplitude = 5.0 * kDegree, .period_s = 30.0, .phase_rad = 0.7},
                       {.mean = 0.5, .amplitude = 60.0 * kDegree, .phase_rad = 0.3}}};
  const Largest largest = errors_along(motion, 0.01, testing::kSlowBuild ? 36'000 : 360'000);
  EXPECT_LT(largest.position_m.maxCoeff(), 0.1);
  EXPECT_LT(largest.velocity_mps.maxCoeff(), 1e-3);
  EXPECT_LT(largest.rotation_deg.maxCoeff(), 1e-6);
}

// Sampled, not integrated: the trapezoid's error is of second order in the interval.
TEST(Strapdown, HalvingTheIntervalOfSamplesQuartersTheError) {
  ExactMotion motion;
  motion.start = {0.7, 0.1, 0.0};
  motion.velocity_mps = {{{.amplitude = 4.0, .period_s = 5.0}, {.amplitude = 3.0, .period_s = 7.0}, {}}};
  motion.euler_rad = {{{.amplitude = 0.3, .period_s = 4.0},
                       {.amplitude = 0.2, .period_s = 3.0, .phase_rad = 1.0},
                       {.amplitude = 1.0, .period_s = 6.0}}};
  const auto error = [&motion](double dt_s, int steps) {
    ExactWalk walk(motion);
    NavigationState state = walk.state();
    InertialSample before = walk.sample();
    for (int n = 0; n < steps; ++n) {
      walk.advance(dt_s);
      const InertialSample now = walk.sample();
      state = strapdown_step(state, increment_between(before, now, dt_s), dt_s);
      before = now;
    }
    return error_of(state, walk.state());
  };
  const TrajectoryError coarse = error(0.02, 1000);
  const TrajectoryError fine = error(0.01, 2000);
  EXPECT_NEAR(coarse.rotation_deg.norm() / fine.rotation_deg.norm(), 4.0, 0.2);
  EXPECT_NEAR(coarse.position_m.norm() / fine.position_m.norm(), 4.0, 0.2);
}

/// Sensor at rest at this place, level, heading 0: one step's increment.
BodyIncrement at_rest(const GeodeticPosition& place, double dt_s) {
  return {dt_s * earth_rate_radps(place.latitude_rad),
          {0.0, 0.0, -dt_s * normal_gravity_mps2(place.latitude_rad, place.height_m)}};
}

// A level error theta makes v = g theta / W sin(W t), W = (g / R)^(1/2): Schuler's 84.4 minutes (Groves 2013,
// section 5.7.2). The sensor's own increments are those of rest, so that only the error moves. The equator's
// meridian radius is 6335.4 km: 84.3 min there. Foucault's turning leaves the first zero within 1 %.
TEST(Strapdown, ALevelErrorOscillatesWithSchulersPeriod) {
  const GeodeticPosition place{0.0, 0.0, 0.0};
  constexpr double kDt_s = 1.0;
  constexpr double kTilt_rad = 1e-5;
  const BodyIncrement increment = at_rest(place, kDt_s);
  NavigationState state{place, Eigen::Vector3d::Zero(), attitude_of({0.0, -kTilt_rad, 0.0})};
  double peak_mps = 0.0;
  double zero_s = 0.0;
  for (int n = 1; zero_s == 0.0 && n < 4000; ++n) {
    const double before = state.velocity_mps.x();
    state = strapdown_step(state, increment, kDt_s);
    peak_mps = std::max(peak_mps, std::abs(state.velocity_mps.x()));
    if (n > 100 && before * state.velocity_mps.x() < 0.0) zero_s = n * kDt_s;
  }
  const double schuler = std::sqrt(kGravityAtEquator_mps2 / meridian_radius_m(0.0));
  EXPECT_NEAR(zero_s, std::numbers::pi / schuler, 0.01 * std::numbers::pi / schuler);
  EXPECT_NEAR(2.0 * std::numbers::pi / schuler / 60.0, 84.4, 0.2);
  const double expected = kGravityAtEquator_mps2 * kTilt_rad / schuler;
  EXPECT_NEAR(peak_mps, expected, 0.01 * expected);
}

// Nothing holds the body: it falls by g t^2 / 2; over 2 s (20 m) gravity grows by 6e-5, the Coriolis force of
// falling pushes east by w g cos L t^3 / 3 (Goldstein, "Classical Mechanics", section 4.10).
TEST(Strapdown, FallsFreelyAndALittleEast) {
  const GeodeticPosition place{0.7, 0.0, 1000.0};
  constexpr double kDt_s = 0.01;
  constexpr double kTime_s = 2.0;
  NavigationState state{place, Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity()};
  for (int n = 0; n < 200; ++n) state = strapdown_step(state, {}, kDt_s);
  const Eigen::Vector3d way = way_m(place, state.position);
  const double g = normal_gravity_mps2(0.7, 1000.0);
  EXPECT_NEAR(way.z(), 0.5 * g * kTime_s * kTime_s, 5e-5);
  const double east = kEarthRate_radps * g * std::cos(0.7) * kTime_s * kTime_s * kTime_s / 3.0;
  EXPECT_NEAR(way.y(), east, 1e-3 * east);
}

TEST(Strapdown, KeepsTheQuaternionAtLengthOne) {
  NavigationState state;
  const BodyIncrement spinning{{0.3, -0.2, 0.5}, {0.0, 0.0, -0.1}};
  for (int n = 0; n < 100'000; ++n) state = strapdown_step(state, spinning, 0.01);
  EXPECT_NEAR(state.attitude.norm(), 1.0, 1e-15);
}

TEST(Strapdown, AllocatesNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "a sanitizer has the heap";
  NavigationState state;
  const InertialSample sample{{0.3, -0.2, 0.5}, {0.1, 0.2, -9.8}};
  const std::uint64_t before = testing::allocations();
  for (int n = 0; n < 100; ++n) state = strapdown_step(state, increment_between(sample, sample, 0.01), 0.01);
  EXPECT_EQ(testing::allocations(), before);
}

TEST(Strapdown, InterpolatesBetweenTwoStates) {
  const NavigationState a{{0.1, 0.2, 100.0}, {1.0, 2.0, 3.0}, Eigen::Quaterniond::Identity()};
  const NavigationState b{{0.2, 0.4, 200.0}, {3.0, 2.0, 1.0}, quaternion_of({0.0, 0.0, 1.0})};
  const NavigationState middle = interpolated(a, b, 0.5);
  EXPECT_DOUBLE_EQ(middle.position.latitude_rad, 0.15);
  EXPECT_DOUBLE_EQ(middle.position.height_m, 150.0);
  EXPECT_LT((middle.velocity_mps - Eigen::Vector3d(2.0, 2.0, 2.0)).norm(), 1e-15);
  EXPECT_LT((rotation_of(middle.attitude) - Eigen::Vector3d(0.0, 0.0, 0.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace gyrod::core
