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

/// Of the sum of all blocks, or of the signal in them.
inline Signal autocovariance(const core::BlockSet& set, std::size_t lags, bool signal) {
  Signal sum(lags);
  for (const core::FilterBlock& block : set.all()) {
    const Signal r = autocovariance(block, lags);
    for (std::size_t l = 0; l < lags; ++l) sum[l] += (signal ? block.signal : 1.0) * r[l];
  }
  return sum;
}

inline Eigen::MatrixXd covariance(const Signal& r) {
  const auto n = static_cast<Eigen::Index>(r.size());
  return Eigen::MatrixXd::NullaryExpr(
      n, n, [&r](Eigen::Index i, Eigen::Index j) { return r[static_cast<std::size_t>(std::abs(i - j))]; });
}

/// Of samples: all blocks in white noise.
inline Eigen::MatrixXd sample_covariance(const core::BlockSet& set, std::size_t samples) {
  Eigen::MatrixXd C = covariance(autocovariance(set, samples, false));
  C.diagonal().array() += kBankNoise;
  return C;
}

/// E[s | z] and the diagonal of its error's covariance, with s the sum of the signal blocks; and what each sample is beside all others.
struct Batch {
  Batch(const core::BlockSet& set, const Signal& z) {
    const auto n = static_cast<Eigen::Index>(z.size());
    const Eigen::MatrixXd Cs = covariance(autocovariance(set, z.size(), true));
    const Eigen::LDLT<Eigen::MatrixXd> solver(sample_covariance(set, z.size()));
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
