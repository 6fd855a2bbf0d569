/// Steady state of the discrete-time Kalman filter.
#pragma once

#include <Eigen/Core>

#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// Square matrix and vector of a state of up to kMaxArOrder elements; live on the stack, never allocate.
using StateMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxArOrder, kMaxArOrder>;
using StateVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxArOrder, 1>;

/// x[k] = A x[k-1] + w,  z[k] = h' x[k] + v,  w ~ N(0, Q), v ~ N(0, r).
struct StateSpace {
  StateMatrix A;   ///< n x n, spectral radius below 1
  StateMatrix Q;   ///< n x n, symmetric, positive semi-definite, unit^2
  StateVector h;   ///< n
  double r = 0.0;  ///< positive, unit^2
};

/// Solves the discrete algebraic Riccati equation for the covariance X of the state's prediction,
///   X = A (X - X h (h' X h + r)^-1 h' X) A' + Q,
/// by structured doubling: with (a, G, X) = (A', h h'/r, Q) and W = I + G X,
///   a <- a W^-1 a,   G <- G + a W^-1 G a',   X <- X + (W^-1 a)' X a,
/// which squares the closed loop in every step. Allocates nothing.
/// @return false where it did not settle within kMaxDoublings or left the finite numbers; X is then undefined
/// Source: Chu, Fan, Lin, Wang 2004, "Structure-preserving algorithms for periodic discrete-time algebraic
/// Riccati equations".
[[nodiscard]] bool solve_riccati(const StateSpace& model, StateMatrix& X) noexcept;

/// The same in extended precision, where the compiler has it, and slower: for modes so slow and smooth that a step of theirs is 1e-10
/// of their size.
[[nodiscard]] bool solve_riccati_precisely(const StateSpace& model, StateMatrix& X) noexcept;

}  // namespace gyrod::core
