#include "core/inertial/strapdown.hpp"

#include "core/inertial/attitude.hpp"

namespace gyrod::core {
namespace {

/// What the earth does to a vehicle at one place and velocity, NED.
struct Surroundings {
  Eigen::Vector3d frame_rate_radps;   ///< w_in = w_ie + w_en
  Eigen::Vector3d acceleration_mps2;  ///< g - (2 w_ie + w_en) x v
};

Surroundings surroundings(const GeodeticPosition& position, const Eigen::Vector3d& velocity_mps) noexcept {
  const Eigen::Vector3d earth = earth_rate_radps(position.latitude_rad);
  const Eigen::Vector3d transport = transport_rate_radps(position, velocity_mps);
  const Eigen::Vector3d gravity(0.0, 0.0, normal_gravity_mps2(position.latitude_rad, position.height_m));
  return {earth + transport, gravity - (2.0 * earth + transport).cross(velocity_mps)};
}

/// dv + dtheta x (dtheta x dv) / 6: the next term of the turning body axes after those in the increment.
Eigen::Vector3d turned_velocity(const BodyIncrement& increment) noexcept {
  const Eigen::Vector3d& turn = increment.rotation_rad;
  return increment.velocity_mps + turn.cross(turn.cross(increment.velocity_mps)) / 6.0;
}

Eigen::Vector3d next_velocity(const NavigationState& state, const BodyIncrement& increment, double dt_s,
                              const Surroundings& around) noexcept {
  const Eigen::Quaterniond half_turn = quaternion_of(-0.5 * dt_s * around.frame_rate_radps);
  return state.velocity_mps + half_turn * (state.attitude * turned_velocity(increment)) +
         dt_s * around.acceleration_mps2;
}

}  // namespace

NavigationState strapdown_step(const NavigationState& state, const BodyIncrement& increment,
                               double dt_s) noexcept {
  const Eigen::Vector3d first_guess =
      next_velocity(state, increment, dt_s, surroundings(state.position, state.velocity_mps));
  const Eigen::Vector3d middle_velocity = 0.5 * (state.velocity_mps + first_guess);
  const GeodeticPosition middle = moved(state.position, 0.5 * dt_s * middle_velocity);
  const Surroundings around = surroundings(middle, middle_velocity);

  NavigationState next;
  next.velocity_mps = next_velocity(state, increment, dt_s, around);
  next.position = moved(state.position, 0.5 * dt_s * (state.velocity_mps + next.velocity_mps));
  next.attitude =
      quaternion_of(-dt_s * around.frame_rate_radps) * state.attitude * quaternion_of(increment.rotation_rad);
  next.attitude.normalize();
  return next;
}

NavigationState interpolated(const NavigationState& from, const NavigationState& to, double share) noexcept {
  NavigationState state;
  state.position.latitude_rad =
      from.position.latitude_rad + share * (to.position.latitude_rad - from.position.latitude_rad);
  state.position.longitude_rad =
      from.position.longitude_rad + share * (to.position.longitude_rad - from.position.longitude_rad);
  state.position.height_m = from.position.height_m + share * (to.position.height_m - from.position.height_m);
  state.velocity_mps = from.velocity_mps + share * (to.velocity_mps - from.velocity_mps);
  state.attitude = from.attitude.slerp(share, to.attitude);
  return state;
}

}  // namespace gyrod::core
