/// From samples of angular rate and specific force to the increments that a strapdown step takes.
///
/// What is assumed: between two samples rate and specific force run along straight lines. Their integrals are
/// then the trapezoids, and rotation vector and velocity change follow from them with one term each for
/// coning and sculling. Sources: [Savage] Savage 1998, "Strapdown inertial navigation integration algorithm
/// design", parts 1 and 2, JGCD 21(1) and 21(2); [Groves] Groves 2013, sections 5.5.4 and 5.5.5. All functions
/// are pure, allocate nothing and are safe to call from any thread.
#pragma once

#include <Eigen/Core>

namespace gyrod::core {

/// One sample of a strapdown sensor in body axes.
struct InertialSample {
  Eigen::Vector3d rate_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();
};

/// Plain integrals over one interval, component by component in the turning body's axes: what an integrating
/// sensor counts.
struct InertialIntegral {
  Eigen::Vector3d angle_rad = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
};

/// What happened in one interval, ready for strapdown_step().
struct BodyIncrement {
  /// Rotation vector of the body's axes at the end against those at the beginning.
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
  /// Change of velocity by specific force, in body axes at the beginning.
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
};

/// Increment between two samples, dt apart, w and f along straight lines:
///   alpha = dt (w0 + w1)/2,  v = dt (f0 + f1)/2,
///   rotation = alpha + dt^2/12 w0 x w1,                                          coning, [Savage] part 1 (33)
///   velocity = v + alpha x v / 2 + dt^2/12 (w0 x f1 + f0 x w1).                  sculling, [Savage] part 2
/// On straight lines the rotation is exact to third order in dt, the velocity but for dtheta x (dtheta x dv) / 6, which
/// strapdown_step() adds.
/// @pre dt_s > 0
[[nodiscard]] BodyIncrement increment_between(const InertialSample& from, const InertialSample& to,
                                              double dt_s) noexcept;

/// Increment of an interval from its own integrals and those of the interval before, which is as long; w and f
/// along one straight line through both:
///   rotation = alpha1 + alpha0 x alpha1 / 12,
///   velocity = v1 + alpha1 x v1 / 2 + (alpha0 x v1 + v0 x alpha1) / 12.
[[nodiscard]] BodyIncrement increment_of(const InertialIntegral& before,
                                         const InertialIntegral& now) noexcept;

}  // namespace gyrod::core
