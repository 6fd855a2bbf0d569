#include "core/inertial/trajectory_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/inertial/attitude.hpp"
#include "core/inertial/truth.hpp"

namespace gyrod::core {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

void add_all(std::array<ErrorAccumulator, 3>& sums, const Eigen::Vector3d& values) noexcept {
  for (std::size_t i = 0; i < 3; ++i) sums[i].add(values[static_cast<Eigen::Index>(i)]);
}

std::array<ErrorStatistics, 3> all_of(const std::array<ErrorAccumulator, 3>& sums) noexcept {
  return {sums[0].statistics(), sums[1].statistics(), sums[2].statistics()};
}

}  // namespace

TrajectoryError error_of(const NavigationState& solution, const NavigationState& truth) noexcept {
  TrajectoryError error;
  error.euler_deg.setConstant(std::numeric_limits<double>::quiet_NaN());
  error.rotation_deg = error.euler_deg;
  if (is_known(truth.attitude)) {
    const EulerAngles a = euler_of(solution.attitude);
    const EulerAngles b = euler_of(truth.attitude);
    error.euler_deg =
        kDegPerRad * Eigen::Vector3d(wrapped(a.roll_rad - b.roll_rad), a.pitch_rad - b.pitch_rad,
                                     wrapped(a.heading_rad - b.heading_rad));
    error.rotation_deg = kDegPerRad * rotation_of(solution.attitude * truth.attitude.conjugate());
  }
  error.velocity_mps = solution.velocity_mps - truth.velocity_mps;
  error.position_m = way_m(truth.position, solution.position);
  return error;
}

void ErrorAccumulator::add(double value) noexcept {
  if (!std::isfinite(value)) return;
  ++count_;
  const double step = value - mean_;
  mean_ += step / static_cast<double>(count_);
  squares_ += step * (value - mean_);
  max_abs_ = std::max(max_abs_, std::abs(value));
}

ErrorStatistics ErrorAccumulator::statistics() const noexcept {
  if (count_ == 0) return {};
  const double variance = squares_ / static_cast<double>(count_);
  return {count_, mean_, std::sqrt(variance), std::sqrt(mean_ * mean_ + variance), max_abs_};
}

void TrajectoryAccumulator::add(const TrajectoryError& error) noexcept {
  add_all(euler_, error.euler_deg);
  add_all(rotation_, error.rotation_deg);
  total_.add(error.rotation_deg.norm());
  add_all(velocity_, error.velocity_mps);
  add_all(position_, error.position_m);
  horizontal_.add(std::hypot(error.position_m.x(), error.position_m.y()));
}

TrajectoryStatistics TrajectoryAccumulator::statistics() const noexcept {
  return {all_of(euler_),    all_of(rotation_), total_.statistics(),
          all_of(velocity_), all_of(position_), horizontal_.statistics()};
}

}  // namespace gyrod::core
