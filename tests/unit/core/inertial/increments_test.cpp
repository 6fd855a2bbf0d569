// Coning and sculling against closed forms.
#include "core/inertial/increments.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/inertial/attitude.hpp"

namespace gyrod::core {
namespace {

// Constant rate and force: no coning, no sculling, the turning of the axes stays. Expected by hand:
// alpha x v / 2 = (.01, 0, -.01) x (0, 0, .1) / 2 = (0, -.5e-3, 0).
TEST(Increments, OfConstantRateAndForceAreTheKnownAnswer) {
  const InertialIntegral half_step{{0.01, 0.0, -0.01}, {0.0, 0.0, 0.1}};
  const BodyIncrement increment = increment_of(half_step, half_step);
  EXPECT_LE((increment.rotation_rad - half_step.angle_rad).norm(), 1e-10 * 0.0141);
  const Eigen::Vector3d expected(0.0, -0.5e-3, 0.1);
  EXPECT_LE((increment.velocity_mps - expected).norm(), 1e-10 * expected.norm());

  constexpr double kDt_s = 0.02;
  const InertialSample sample{half_step.angle_rad / kDt_s, half_step.velocity_mps / kDt_s};
  const BodyIncrement between = increment_between(sample, sample, kDt_s);
  EXPECT_LE((between.rotation_rad - increment.rotation_rad).norm(), 1e-17);
  EXPECT_LE((between.velocity_mps - increment.velocity_mps).norm(), 1e-17);
}

/// w and f that run along straight lines.
struct LinearMotion {
  InertialSample at_zero{{0.9, -0.4, 0.3}, {1.0, 5.0, -9.0}};
  InertialSample slope{{-2.0, 3.0, 1.5}, {30.0, -20.0, 12.0}};

  [[nodiscard]] InertialSample at(double t) const {
    return {at_zero.rate_radps + t * slope.rate_radps,
            at_zero.specific_force_mps2 + t * slope.specific_force_mps2};
  }
  [[nodiscard]] InertialIntegral between(double from, double to) const {
    const InertialSample middle = at(0.5 * (from + to));
    return {(to - from) * middle.rate_radps, (to - from) * middle.specific_force_mps2};
  }
  /// Rotation and velocity change by thousands of midpoint steps, whose own error is 1e-7 of the corrections'.
  [[nodiscard]] BodyIncrement exact(double dt_s) const {
    constexpr int kSteps = 4000;
    Eigen::Quaterniond turned = Eigen::Quaterniond::Identity();
    BodyIncrement sums;
    for (int n = 0; n < kSteps; ++n) {
      const double step = dt_s / kSteps;
      const InertialSample middle = at((n + 0.5) * step);
      sums.velocity_mps +=
          step * (turned * quaternion_of(0.5 * step * middle.rate_radps) * middle.specific_force_mps2);
      turned = turned * quaternion_of(step * middle.rate_radps);
    }
    sums.rotation_rad = rotation_of(turned);
    return sums;
  }
};

// Halving the interval: the rotation's first term left out is of fourth order or higher, so is the velocity's once
// the step's own term dtheta x (dtheta x dv) / 6 is added: 16 times smaller. A missing or wrong coning or sculling
// term is of third order on straight lines: 8 times. kSteps keeps the reference's own error far below.
TEST(Increments, AreExactToThirdOrderOnStraightLines) {
  const LinearMotion motion;
  double last_rotation = 0.0;
  double last_velocity = 0.0;
  for (const double dt_s : {0.08, 0.04, 0.02}) {
    const BodyIncrement increment = increment_between(motion.at(0.0), motion.at(dt_s), dt_s);
    const BodyIncrement exact = motion.exact(dt_s);
    const Eigen::Vector3d& turn = increment.rotation_rad;
    const Eigen::Vector3d turned =
        increment.velocity_mps + turn.cross(turn.cross(increment.velocity_mps)) / 6.0;
    const double rotation = (turn - exact.rotation_rad).norm();
    const double velocity = (turned - exact.velocity_mps).norm();
    if (last_rotation > 0.0) {
      EXPECT_GT(last_rotation / rotation, 14.0);
      EXPECT_GT(last_velocity / velocity, 14.0);
    }
    last_rotation = rotation;
    last_velocity = velocity;
  }
}

// Both forms see the same straight line, one at its samples, one by its integrals.
TEST(Increments, FromSamplesAndFromIntegralsAgree) {
  const LinearMotion motion;
  constexpr double kDt_s = 0.01;
  const BodyIncrement a = increment_between(motion.at(kDt_s), motion.at(2.0 * kDt_s), kDt_s);
  const BodyIncrement b = increment_of(motion.between(0.0, kDt_s), motion.between(kDt_s, 2.0 * kDt_s));
  EXPECT_LE((a.rotation_rad - b.rotation_rad).norm(), 1e-16);
  EXPECT_LE((a.velocity_mps - b.velocity_mps).norm(), 1e-16);
}

/// Coning: the x axis stays, y and z nutate. q(t) = (cos a/2, 0, sin a/2 cos Wt, sin a/2 sin Wt), whose body rate
/// is w = (-2 W sin^2 a/2, -W sin a sin Wt, W sin a cos Wt).
struct Coning {
  double half_angle_rad = 0.02;
  double frequency_radps = 60.0;

  [[nodiscard]] Eigen::Quaterniond at(double t) const {
    const double sine = std::sin(0.5 * half_angle_rad);
    return {std::cos(0.5 * half_angle_rad), 0.0, sine * std::cos(frequency_radps * t),
            sine * std::sin(frequency_radps * t)};
  }
  [[nodiscard]] Eigen::Vector3d angle_between(double from, double to) const {
    const double sine = std::sin(0.5 * half_angle_rad);
    const double a = std::sin(half_angle_rad);
    return {-2.0 * frequency_radps * sine * sine * (to - from),
            a * (std::cos(frequency_radps * to) - std::cos(frequency_radps * from)),
            a * (std::sin(frequency_radps * to) - std::sin(frequency_radps * from))};
  }
};

// Without the term the x axis drifts, per second, by W sin^2(a)/2 (1 - sin(WT)/(WT)), Savage 1998 part 1 section
// "coning"; Bortz 1971. With it what is left is of order (WT)^4: less than a tenth at WT = 0.6.
TEST(Increments, ConingTermTakesOffTheClassicalDrift) {
  const Coning motion;
  constexpr double kDt_s = 0.01;
  constexpr int kSteps = 10'000;
  Eigen::Quaterniond plain = motion.at(0.0);
  Eigen::Quaterniond corrected = plain;
  InertialIntegral before{motion.angle_between(-kDt_s, 0.0), Eigen::Vector3d::Zero()};
  for (int n = 0; n < kSteps; ++n) {
    const InertialIntegral now{motion.angle_between(n * kDt_s, (n + 1) * kDt_s), Eigen::Vector3d::Zero()};
    plain = plain * quaternion_of(now.angle_rad);
    corrected = corrected * quaternion_of(increment_of(before, now).rotation_rad);
    before = now;
  }
  const double time_s = kSteps * kDt_s;
  const Eigen::Quaterniond truth = motion.at(time_s);
  const double wt = motion.frequency_radps * kDt_s;
  const double sine = std::sin(motion.half_angle_rad);
  const double expected = 0.5 * motion.frequency_radps * sine * sine * (1.0 - std::sin(wt) / wt) * time_s;
  const double drift = rotation_of(plain * truth.conjugate()).norm();
  EXPECT_NEAR(drift, expected, 0.01 * expected);
  EXPECT_LT(rotation_of(corrected * truth.conjugate()).norm(), 0.1 * expected);
}

}  // namespace
}  // namespace gyrod::core
