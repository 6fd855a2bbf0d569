#include "core/denoise/ar_kalman.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {

bool ArKalman::design(std::span<const double> a, double q, double r) noexcept {
  assert(!a.empty() && a.size() <= kMaxArOrder);
  if (!(q > 0.0) || !(r > 0.0)) return false;
  const auto p = static_cast<Eigen::Index>(a.size());
  // The gain depends on q / r alone; solving in units of r keeps rad/s data, where r is 1e-6, well scaled.
  model_.A.setZero(p, p);
  for (Eigen::Index i = 0; i < p; ++i) model_.A(0, i) = a[static_cast<std::size_t>(i)];
  for (Eigen::Index i = 1; i < p; ++i) model_.A(i, i - 1) = 1.0;
  model_.Q.setZero(p, p);
  model_.Q(0, 0) = q / r;
  model_.h.setZero(p);
  model_.h(0) = 1.0;
  model_.r = 1.0;
  if (!solve_riccati(model_, covariance_)) return false;

  const double s = covariance_(0, 0) + 1.0;
  gain_ = covariance_.col(0) / s;
  innovation_variance_ = s * r;
  error_variance_ = gain_(0) * r;
  return gain_.allFinite() && std::isfinite(innovation_variance_);
}

void ArKalman::filter(std::span<double> z) noexcept {
  const auto p = gain_.size();
  const auto start = std::min(static_cast<std::size_t>(p), z.size());
  state_.setZero(p);
  for (std::size_t i = 0; i < start; ++i) state_(static_cast<Eigen::Index>(start - 1 - i)) = z[i];
  for (std::size_t k = start; k < z.size(); ++k) {
    const double prediction = model_.A.row(0).dot(state_);
    const double innovation = z[k] - prediction;
    for (Eigen::Index i = p - 1; i > 0; --i) state_(i) = state_(i - 1) + gain_(i) * innovation;
    state_(0) = prediction + gain_(0) * innovation;
    z[k] = state_(0);
  }
}

}  // namespace gyrod::core
