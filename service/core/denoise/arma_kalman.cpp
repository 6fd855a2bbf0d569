#include "core/denoise/arma_kalman.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <Eigen/Cholesky>

namespace gyrod::core {

bool ArmaKalman::design(const ArmaModel& model, double driving_variance, double noise_variance) noexcept {
  static_assert(kMaxMaOrder + 1 <= kMaxArOrder);
  if (!(driving_variance > 0.0) || !(noise_variance > 0.0)) return false;
  const auto m = static_cast<Eigen::Index>(std::max(model.p, model.q + 1));
  a_.setZero(m);
  StateVector g = StateVector::Zero(m);
  g(0) = 1.0;
  for (std::size_t i = 0; i < model.p; ++i) a_(static_cast<Eigen::Index>(i)) = model.a[i];
  for (std::size_t i = 0; i < model.q; ++i) g(static_cast<Eigen::Index>(i + 1)) = model.b[i];

  // In units of r, as in ArKalman.
  StateSpace space;
  space.A.setZero(m, m);
  space.A.col(0) = a_;
  for (Eigen::Index i = 0; i + 1 < m; ++i) space.A(i, i + 1) = 1.0;
  space.Q = driving_variance / noise_variance * g * g.transpose();
  space.h.setZero(m);
  space.h(0) = 1.0;
  space.r = 1.0;
  if (!solve_riccati_precisely(space, covariance_)) return false;

  const double s = covariance_(0, 0) + 1.0;
  gain_ = covariance_.col(0) / s;
  innovation_variance_ = s * noise_variance;
  error_variance_ = gain_(0) * noise_variance;
  return gain_.allFinite() && std::isfinite(innovation_variance_);
}

double ArmaKalman::step(StateVector& state, double measured) const noexcept {
  const Eigen::Index m = gain_.size();
  const double newest = state(0);
  const double prediction = a_(0) * newest + (m > 1 ? state(1) : 0.0);
  const double innovation = measured - prediction;
  for (Eigen::Index i = 1; i < m; ++i) {
    const double shifted = i + 1 < m ? state(i + 1) : 0.0;
    state(i) = a_(i) * newest + shifted + gain_(i) * innovation;
  }
  state(0) = prediction + gain_(0) * innovation;
  return innovation;
}

/// The filter is linear: its innovations from a start x are those from 0 on z, plus sum_i x_i times those from the unit vector e_i on
/// zeros. Normal equations of that regression, in long double since slow modes look alike for a while.
StateVector ArmaKalman::fitted_start(std::span<const double> z) const noexcept {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxArOrder, kMaxArOrder>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1, 0, kMaxArOrder, 1>;
  constexpr long double kRidge = 1e-15L;  // of the trace: keeps a start that no innovation shows at 0
  const Eigen::Index m = gain_.size();
  StateVector from_zero = StateVector::Zero(m);
  std::array<StateVector, kMaxArOrder> from_unit;
  for (Eigen::Index i = 0; i < m; ++i) from_unit[static_cast<std::size_t>(i)] = StateVector::Unit(m, i);
  Matrix squares = Matrix::Zero(m, m);
  Vector products = Vector::Zero(m);
  Vector response = Vector::Zero(m);
  for (const double measured : z.first(std::min(z.size(), kStartSamples))) {
    const double innovation = step(from_zero, measured);
    for (Eigen::Index i = 0; i < m; ++i) response(i) = step(from_unit[static_cast<std::size_t>(i)], 0.0);
    squares += response * response.transpose();
    products -= innovation * response;
  }
  const long double trace = squares.trace();
  if (!(trace > 0.0L) || !std::isfinite(trace)) return StateVector::Zero(m);
  squares.diagonal().array() += kRidge * trace;
  const StateVector start = squares.ldlt().solve(products).template cast<double>();
  return start.allFinite() ? start : StateVector::Zero(m);
}

void ArmaKalman::filter(std::span<double> z) noexcept {
  StateVector state = fitted_start(z);
  for (double& value : z) {
    step(state, value);
    value = state(0);
  }
}

}  // namespace gyrod::core
