/// Strapdown mechanisation: attitude, velocity and position on WGS-84, one increment at a time.
///
/// Sources: [Savage] Savage 1998, JGCD 21(1) and 21(2); [Groves] Groves 2013, section 5.5; the equations by
/// number are in docs/navigation.md.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/inertial/earth.hpp"
#include "core/inertial/increments.hpp"

namespace gyrod::core {

struct NavigationState {
  GeodeticPosition position;
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();        ///< north, east, down, over ground
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< body to NED, of length one
};

/// The state at the end of one interval of dt_s:
///   zeta = (w_ie + w_en) dt,                                                 turn of the NED axes
///   dv' = dv + dtheta x (dtheta x dv) / 6,
///   v1 = v0 + exp(-zeta/2) C0 dv' + (g - (2 w_ie + w_en) x v) dt,            C0 of the attitude at the start
///   position by the mean of v0 and v1,
///   q1 = exp(-zeta) q0 exp(dtheta), and to length one again.
/// The third-order term of dv' matters: without it a body that turns and swings by some deg/s falls by 8 m in an
/// hour at 100 Hz. Earth rate w_ie, transport rate w_en, gravity g and the Coriolis term's v are those in the middle
/// of the interval, found by a first pass that uses the ones at its start: second order throughout. Allocates
/// nothing; pure, safe to call from any thread. The vertical channel is unstable, as it is in any unaided one: an
/// error of height grows by e in 9.5 minutes.
/// @pre dt_s > 0, state and increment finite, not within a step of a pole
[[nodiscard]] NavigationState strapdown_step(const NavigationState& state, const BodyIncrement& increment,
                                             double dt_s) noexcept;

/// The state between two others, share 0..1 of the way: position, velocity along straight lines, attitude along
/// the great circle.
[[nodiscard]] NavigationState interpolated(const NavigationState& from, const NavigationState& to,
                                           double share) noexcept;

}  // namespace gyrod::core
