#include "core/inertial/truth_calibration.hpp"

#include <vector>

#include <Eigen/Cholesky>

#include "core/inertial/attitude.hpp"

namespace gyrod::core {
namespace {

/// Normal equations of e = D b.
struct LeastSquares {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  std::size_t count = 0;

  void add(const Eigen::Matrix3d& D, const Eigen::Vector3d& e) {
    normal += D.transpose() * D;
    right += D.transpose() * e;
    ++count;
  }
  [[nodiscard]] Eigen::Vector3d solution() const {
    return count == 0 ? Eigen::Vector3d::Zero().eval() : normal.ldlt().solve(right).eval();
  }
};

struct Leg {
  std::size_t first = 0;
  std::size_t end = 0;  ///< its last sample
  NavigationState from;
  NavigationState to;
};

/// Legs one after the other with known attitude at both ends.
std::vector<Leg> legs_of(const InertialSeries& series, const Truth& truth, const GeodeticPosition& reference,
                         const TruthCalibrationOptions& options) {
  std::vector<Leg> legs;
  std::size_t first = 0;
  for (std::size_t n = 1; n < series.size(); ++n) {
    if (series.time_s[n] - series.time_s[first] < options.leg_s) continue;
    Leg leg{first, n, truth_at(truth, series.time_s[first], options.max_gap_s),
            truth_at(truth, series.time_s[n], options.max_gap_s)};
    first = n;
    if (!is_known(leg.from.attitude) || !is_known(leg.to.attitude)) continue;
    if (!is_known(leg.from.position)) leg.from.position = reference;
    legs.push_back(leg);
  }
  return legs;
}

Eigen::Matrix3d sum_of_attitudes(const InertialSeries& series, const Leg& leg,
                                 const std::vector<NavigationState>& states) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 1; k < states.size(); ++k) {
    const double dt_s = series.time_s[leg.first + k] - series.time_s[leg.first + k - 1];
    sum += 0.5 * dt_s * (states[k - 1].attitude.toRotationMatrix() + states[k].attitude.toRotationMatrix());
  }
  return sum;
}

Eigen::Vector3d gyro_bias(const InertialSeries& series, const std::vector<Leg>& legs) {
  LeastSquares sums;
  for (const Leg& leg : legs) {
    NavigationState start = leg.from;
    if (!is_known(start.velocity_mps)) start.velocity_mps.setZero();
    const auto states = dead_reckoned(series, leg.first, leg.end + 1, start, {});
    sums.add(sum_of_attitudes(series, leg, states),
             rotation_of(states.back().attitude * leg.to.attitude.conjugate()));
  }
  return sums.solution();
}

}  // namespace

std::optional<TruthCalibration> calibrated_on_truth(const InertialSeries& series, const Truth& truth,
                                                    const GeodeticPosition& reference,
                                                    const TruthCalibrationOptions& options) {
  const std::vector<Leg> legs = legs_of(series, truth, reference, options);
  if (legs.empty()) return std::nullopt;
  TruthCalibration found;
  found.legs = legs.size();
  found.bias.gyro_radps = gyro_bias(series, legs);

  LeastSquares sums;
  for (const Leg& leg : legs) {
    if (!is_known(leg.from.velocity_mps) || !is_known(leg.to.velocity_mps)) continue;
    const auto states = dead_reckoned(series, leg.first, leg.end + 1, leg.from, found.bias);
    sums.add(sum_of_attitudes(series, leg, states), states.back().velocity_mps - leg.to.velocity_mps);
  }
  found.velocity_legs = sums.count;
  found.bias.accel_mps2 = sums.solution();
  return found;
}

}  // namespace gyrod::core
