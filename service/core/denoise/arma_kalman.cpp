#include "core/denoise/arma_kalman.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {

bool ArmaKalman::design(const ArmaModel& model, double driving_variance, double noise_variance) noexcept {
  static_assert(kMaxMaOrder + 1 <= kMaxArOrder);
  if (!(driving_variance > 0.0) || !(noise_variance > 0.0)) return false;
  const auto m = static_cast<Eigen::Index>(std::max(model.p, model.q + 1));
  p_ = model.p;
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

/// The state after p samples without noise: x_i = sum_(l >= i) a_l s[k-1-(l-i)] for i = 2..m, x_1 = s[k].
void ArmaKalman::start(std::span<const double> measured) noexcept {
  const Eigen::Index m = gain_.size();
  const auto count = static_cast<Eigen::Index>(measured.size());
  state_.setZero(m);
  if (count == 0) return;
  const auto before = [&](Eigen::Index age) {
    return age < count ? measured[static_cast<std::size_t>(count - 1 - age)] : 0.0;
  };
  state_(0) = before(0);
  for (Eigen::Index i = 1; i < m; ++i) {
    for (Eigen::Index l = i; l < m; ++l) state_(i) += a_(l) * before(1 + l - i);
  }
}

void ArmaKalman::filter(std::span<double> z) noexcept {
  const Eigen::Index m = gain_.size();
  const std::size_t known = std::min(p_, z.size());
  start(z.first(known));
  for (std::size_t k = known; k < z.size(); ++k) {
    const double newest = state_(0);
    const double prediction = a_(0) * newest + (m > 1 ? state_(1) : 0.0);
    const double innovation = z[k] - prediction;
    for (Eigen::Index i = 1; i < m; ++i) {
      const double shifted = i + 1 < m ? state_(i + 1) : 0.0;
      state_(i) = a_(i) * newest + shifted + gain_(i) * innovation;
    }
    state_(0) = prediction + gain_(0) * innovation;
    z[k] = state_(0);
  }
}

}  // namespace gyrod::core
