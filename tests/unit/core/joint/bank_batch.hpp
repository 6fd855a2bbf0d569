/// The conditional mean of a whole record, from covariances alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Dense>

#include "unit/core/joint/bank_support.hpp"

namespace gyrod::testing {

/// r_l = drive sum_k h_k h_(k+l), from the impulse response.
inline Signal autocovariance(const core::FilterBlock& block, std::size_t lags) {
  constexpr std::size_t kLong = 4000;
  Signal h(kLong + lags);
  h[0] = 1.0;
  for (std::size_t k = 1; k < h.size(); ++k) {
    for (std::size_t i = 0; i < std::min(block.order, k); ++i) h[k] += block.a[i] * h[k - 1 - i];
  }
  Signal r(lags);
  for (std::size_t l = 0; l < lags; ++l) {
    for (std::size_t k = 0; k < kLong; ++k) r[l] += block.drive * h[k] * h[k + l];
  }
  return r;
}

/// E[s | z] and the diagonal of its error's covariance, with s the sum of the signal blocks; and what each sample is beside all others.
struct Batch {
  Batch(const core::BlockSet& set, const Signal& z) {
    const auto n = static_cast<Eigen::Index>(z.size());
    Eigen::MatrixXd Cs = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd Cz = kBankNoise * Eigen::MatrixXd::Identity(n, n);
    for (const core::FilterBlock& block : set.all()) {
      const Signal r = autocovariance(block, z.size());
      for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
          const double value = r[static_cast<std::size_t>(std::abs(i - j))];
          Cz(i, j) += value;
          Cs(i, j) += block.signal * value;
        }
      }
    }
    const Eigen::LDLT<Eigen::MatrixXd> solver(Cz);
    mean = Cs * solver.solve(Eigen::Map<const Eigen::VectorXd>(z.data(), n));
    variance = (Cs - Cs * solver.solve(Cs)).diagonal();
    const Eigen::MatrixXd precision = solver.solve(Eigen::MatrixXd::Identity(n, n));
    apart_variance = precision.diagonal().cwiseInverse();
    apart = (precision * Eigen::Map<const Eigen::VectorXd>(z.data(), n)).cwiseProduct(apart_variance);
  }

  Eigen::VectorXd mean;
  Eigen::VectorXd variance;
  Eigen::VectorXd apart;           ///< z[t] - E[z[t] | all other samples]
  Eigen::VectorXd apart_variance;  ///< of that
};

}  // namespace gyrod::testing
