/// A vehicle on a known way, and what an ideal strapdown sensor on it integrates: the other half of the
/// mechanisation, from the motion to the sensor.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/inertial/attitude.hpp"
#include "core/inertial/earth.hpp"
#include "core/inertial/increments.hpp"
#include "core/inertial/strapdown.hpp"

namespace gyrod::testing {

/// mean + amplitude sin(2 pi t / period + phase)
struct Sine {
  double mean = 0.0;
  double amplitude = 0.0;
  double period_s = 60.0;
  double phase_rad = 0.0;

  [[nodiscard]] double angle(double t) const { return 2.0 * std::numbers::pi * t / period_s + phase_rad; }
  [[nodiscard]] double at(double t) const { return mean + amplitude * std::sin(angle(t)); }
  [[nodiscard]] double slope(double t) const {
    return amplitude * 2.0 * std::numbers::pi / period_s * std::cos(angle(t));
  }
};

/// Velocity in NED axes and Euler angles (roll, pitch, heading) as functions of time.
struct ExactMotion {
  std::array<Sine, 3> velocity_mps;
  std::array<Sine, 3> euler_rad;
  core::GeodeticPosition start;

  [[nodiscard]] Eigen::Vector3d velocity(double t) const {
    return {velocity_mps[0].at(t), velocity_mps[1].at(t), velocity_mps[2].at(t)};
  }
  [[nodiscard]] Eigen::Quaterniond attitude(double t) const {
    return core::attitude_of({euler_rad[0].at(t), euler_rad[1].at(t), euler_rad[2].at(t)});
  }
  /// Body rate against inertial space: C'(w_ie + w_en) and the Euler rates, Groves 2013 eq. (2.58).
  [[nodiscard]] Eigen::Vector3d rate(double t, const core::GeodeticPosition& position) const {
    const double roll = euler_rad[0].at(t);
    const double pitch = euler_rad[1].at(t);
    const Eigen::Vector3d slopes(euler_rad[0].slope(t), euler_rad[1].slope(t), euler_rad[2].slope(t));
    const Eigen::Vector3d turn(slopes.x() - std::sin(pitch) * slopes.z(),
                               std::cos(roll) * slopes.y() + std::sin(roll) * std::cos(pitch) * slopes.z(),
                               -std::sin(roll) * slopes.y() + std::cos(roll) * std::cos(pitch) * slopes.z());
    const Eigen::Vector3d frame =
        core::earth_rate_radps(position.latitude_rad) + core::transport_rate_radps(position, velocity(t));
    return attitude(t).conjugate() * frame + turn;
  }
  /// C'(dv/dt + (2 w_ie + w_en) x v - g).
  [[nodiscard]] Eigen::Vector3d specific_force(double t, const core::GeodeticPosition& position) const {
    const Eigen::Vector3d slopes(velocity_mps[0].slope(t), velocity_mps[1].slope(t),
                                 velocity_mps[2].slope(t));
    const Eigen::Vector3d frame = 2.0 * core::earth_rate_radps(position.latitude_rad) +
                                  core::transport_rate_radps(position, velocity(t));
    const Eigen::Vector3d gravity(0.0, 0.0,
                                  core::normal_gravity_mps2(position.latitude_rad, position.height_m));
    return attitude(t).conjugate() * (slopes + frame.cross(velocity(t)) - gravity);
  }
};

/// Walks along an ExactMotion. Position by the classical Runge-Kutta rule on dL/dt = v_N/(M+h) and its like,
/// increments by Gauss's rule with three points: over a step of 10 ms both are exact to rounding.
class ExactWalk {
 public:
  explicit ExactWalk(const ExactMotion& motion) : motion_(motion), position_(motion.start) {}

  [[nodiscard]] core::NavigationState state() const {
    return {position_, motion_.velocity(t_), motion_.attitude(t_)};
  }
  [[nodiscard]] core::InertialSample sample() const {
    return {motion_.rate(t_, position_), motion_.specific_force(t_, position_)};
  }

  /// Goes on by dt_s. @return what an integrating sensor counts on the way
  core::InertialIntegral advance(double dt_s) {
    constexpr std::array<double, 3> kNode = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr std::array<double, 3> kWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    core::InertialIntegral sums;
    for (std::size_t i = 0; i < 3; ++i) {
      const core::GeodeticPosition there = after(kNode[i] * dt_s);
      const double t = t_ + kNode[i] * dt_s;
      sums.angle_rad += kWeight[i] * dt_s * motion_.rate(t, there);
      sums.velocity_mps += kWeight[i] * dt_s * motion_.specific_force(t, there);
    }
    position_ = after(dt_s);
    t_ = dt_s * static_cast<double>(++steps_);
    return sums;
  }

 private:
  [[nodiscard]] Eigen::Vector3d slope(double t, const Eigen::Vector3d& p) const {
    const Eigen::Vector3d v = motion_.velocity(t);
    return {v.x() / (core::meridian_radius_m(p.x()) + p.z()),
            v.y() / ((core::transverse_radius_m(p.x()) + p.z()) * std::cos(p.x())), -v.z()};
  }
  [[nodiscard]] core::GeodeticPosition after(double h) const {
    const Eigen::Vector3d p(position_.latitude_rad, position_.longitude_rad, position_.height_m);
    const Eigen::Vector3d a = slope(t_, p);
    const Eigen::Vector3d b = slope(t_ + 0.5 * h, p + 0.5 * h * a);
    const Eigen::Vector3d c = slope(t_ + 0.5 * h, p + 0.5 * h * b);
    const Eigen::Vector3d d = slope(t_ + h, p + h * c);
    const Eigen::Vector3d next = p + h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    return {next.x(), next.y(), next.z()};
  }

  ExactMotion motion_;
  core::GeodeticPosition position_;
  double t_ = 0.0;
  std::uint64_t steps_ = 0;
};

}  // namespace gyrod::testing
