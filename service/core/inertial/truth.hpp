/// What a vehicle really did, as far as a reference knows it.
///
/// Values that the reference does not have are NaN, in any component. Functions here allocate only what they
/// return and are safe to call from any thread.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/inertial/earth.hpp"
#include "core/inertial/strapdown.hpp"

namespace gyrod::core {

/// A reference trajectory at its own times. Each of the three series is empty (the reference does not measure
/// it) or as long as time_s.
struct Truth {
  std::vector<double> time_s;                 ///< rising
  std::vector<Eigen::Quaterniond> attitude;   ///< body to NED, of length one
  std::vector<Eigen::Vector3d> velocity_mps;  ///< north, east, down
  std::vector<GeodeticPosition> position;

  [[nodiscard]] std::size_t size() const noexcept { return time_s.size(); }
  [[nodiscard]] bool has_attitude() const noexcept { return !attitude.empty(); }
  [[nodiscard]] bool has_velocity() const noexcept { return !velocity_mps.empty(); }
  [[nodiscard]] bool has_position() const noexcept { return !position.empty(); }
};

/// A state with NaN in all it does not know.
[[nodiscard]] NavigationState unknown_state() noexcept;

/// Element `index` of a truth; NaN for series it does not have.
[[nodiscard]] NavigationState state_of(const Truth& truth, std::size_t index) noexcept;

[[nodiscard]] bool is_known(const Eigen::Quaterniond& attitude) noexcept;
[[nodiscard]] bool is_known(const Eigen::Vector3d& velocity_mps) noexcept;
[[nodiscard]] bool is_known(const GeodeticPosition& position) noexcept;

/// The truth at any time, between its two neighbours. Never extrapolates: NaN before its first and after its last
/// element, where a neighbour is NaN, and where they are more than max_gap_s apart. At an element's own time it
/// is that element.
[[nodiscard]] NavigationState truth_at(const Truth& truth, double time_s, double max_gap_s) noexcept;

/// Elements with from_s < time <= to_s: first and one past the last.
[[nodiscard]] std::pair<std::size_t, std::size_t> elements_within(const Truth& truth, double from_s,
                                                                  double to_s) noexcept;

/// The state of a series at any time within it, along a straight line between its two neighbours.
/// @pre states.size() == time_s.size(), not empty; time_s.front() <= time <= time_s.back()
[[nodiscard]] NavigationState state_at(std::span<const double> time_s,
                                       std::span<const NavigationState> states, double time) noexcept;

/// Velocity by differences of position: slope at t of the parabola through p(t) and its nearest known neighbours at
/// least half_width_s before and after. NaN where one is missing, or further away than max_gap_s, or where p(t)
/// itself is NaN. Where the acceleration changes by j per second it is off by j half_width_s^2 / 6.
[[nodiscard]] std::vector<Eigen::Vector3d> differentiated(std::span<const double> time_s,
                                                          std::span<const GeodeticPosition> position,
                                                          double half_width_s, double max_gap_s);

/// An attitude against a local frame with x, y level and z up becomes one against NED, x taken as north.
[[nodiscard]] Eigen::Quaterniond ned_from_z_up(const Eigen::Quaterniond& body_to_z_up) noexcept;
/// The same for a vector: (x, -y, -z).
[[nodiscard]] Eigen::Vector3d ned_from_z_up(const Eigen::Vector3d& z_up) noexcept;

}  // namespace gyrod::core
