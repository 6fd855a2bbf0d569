#include "core/inertial/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gyrod::core {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t index_of(std::span<const double>::iterator place, std::span<const double> all) noexcept {
  return static_cast<std::size_t>(place - all.begin());
}

}  // namespace

NavigationState unknown_state() noexcept {
  NavigationState state;
  state.position = {kNan, kNan, kNan};
  state.velocity_mps.setConstant(kNan);
  state.attitude.coeffs().setConstant(kNan);
  return state;
}

NavigationState state_of(const Truth& truth, std::size_t index) noexcept {
  NavigationState state = unknown_state();
  if (truth.has_attitude()) state.attitude = truth.attitude[index];
  if (truth.has_velocity()) state.velocity_mps = truth.velocity_mps[index];
  if (truth.has_position()) state.position = truth.position[index];
  return state;
}

bool is_known(const Eigen::Quaterniond& attitude) noexcept { return attitude.coeffs().allFinite(); }
bool is_known(const Eigen::Vector3d& velocity_mps) noexcept { return velocity_mps.allFinite(); }
bool is_known(const GeodeticPosition& position) noexcept {
  return std::isfinite(position.latitude_rad) && std::isfinite(position.longitude_rad) &&
         std::isfinite(position.height_m);
}

NavigationState truth_at(const Truth& truth, double time_s, double max_gap_s) noexcept {
  const std::span<const double> times(truth.time_s);
  const auto after = std::lower_bound(times.begin(), times.end(), time_s);
  if (after == times.end()) return unknown_state();
  const std::size_t right = index_of(after, times);
  if (times[right] == time_s) return state_of(truth, right);
  if (right == 0 || times[right] - times[right - 1] > max_gap_s) return unknown_state();
  const double share = (time_s - times[right - 1]) / (times[right] - times[right - 1]);
  return interpolated(state_of(truth, right - 1), state_of(truth, right), share);
}

std::pair<std::size_t, std::size_t> elements_within(const Truth& truth, double from_s, double to_s) noexcept {
  const std::span<const double> times(truth.time_s);
  return {index_of(std::upper_bound(times.begin(), times.end(), from_s), times),
          index_of(std::upper_bound(times.begin(), times.end(), to_s), times)};
}

NavigationState state_at(std::span<const double> time_s, std::span<const NavigationState> states,
                         double time) noexcept {
  const std::size_t right = index_of(std::lower_bound(time_s.begin(), time_s.end(), time), time_s);
  if (time_s[right] == time) return states[right];
  const double share = (time - time_s[right - 1]) / (time_s[right] - time_s[right - 1]);
  return interpolated(states[right - 1], states[right], share);
}

std::vector<Eigen::Vector3d> differentiated(std::span<const double> time_s,
                                            std::span<const GeodeticPosition> position, double half_width_s,
                                            double max_gap_s) {
  std::vector<std::size_t> known;
  for (std::size_t n = 0; n < position.size(); ++n) {
    if (is_known(position[n])) known.push_back(n);
  }
  std::vector<Eigen::Vector3d> velocity(position.size(), Eigen::Vector3d::Constant(kNan));
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t k = 0; k < known.size(); ++k) {
    const double t = time_s[known[k]];
    while (left + 1 < k && time_s[known[left + 1]] <= t - half_width_s) ++left;
    while (right + 1 < known.size() && time_s[known[right]] < t + half_width_s) ++right;
    const double before = t - time_s[known[left]];
    const double behind = time_s[known[right]] - t;
    if (before < half_width_s || behind < half_width_s || std::max(before, behind) > max_gap_s) continue;
    const Eigen::Vector3d slope_before = way_m(position[known[left]], position[known[k]]) / before;
    const Eigen::Vector3d slope_behind = way_m(position[known[k]], position[known[right]]) / behind;
    velocity[known[k]] = (behind * slope_before + before * slope_behind) / (before + behind);
  }
  return velocity;
}

Eigen::Quaterniond ned_from_z_up(const Eigen::Quaterniond& body_to_z_up) noexcept {
  return Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0) * body_to_z_up;  // half a turn about x
}

Eigen::Vector3d ned_from_z_up(const Eigen::Vector3d& z_up) noexcept {
  return {z_up.x(), -z_up.y(), -z_up.z()};
}

}  // namespace gyrod::core
