/// How the points of an Allan curve go together: all of them come from one record.
#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "core/allan/noise_coefficients.hpp"

namespace gyrod::core {

/// Correlation of the estimated Allan variances among the points. A long record's periodogram has independent bins,
/// so that with |H_i(f)|^2 = 2 sin^4(pi f tau_i) / (m_i sin(pi f dt))^2 and the model's spectrum S
///   cov_ij ~ integral |H_i|^2 |H_j|^2 S^2 df,   f from 1 / (2 record) to half the sample rate,
///   S(f) = N^2 + B^2/(2 pi f) + K^2/(2 pi f)^2 + R^2/(2 pi f)^3 + 4 Q^2 sin^2(pi f dt)/dt,
/// summed on log-spaced frequencies. Within 0.15 of simulation (tests).
/// @param squares  Q^2, N^2, B^2, K^2, R^2, not all 0  @param points from one record
/// @return symmetric, points x points, diagonal 1
[[nodiscard]] Eigen::MatrixXd point_correlation(std::span<const AllanPoint> points,
                                                const std::array<double, kNoiseTerms>& squares);

}  // namespace gyrod::core
