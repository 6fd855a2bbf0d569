#include "core/denoise/riccati.hpp"

#include <cassert>

#include <Eigen/LU>

namespace gyrod::core {
namespace {

/// One step of the Riccati recursion, in Joseph form: symmetric and positive whatever the rounding.
StateMatrix riccati_step(const StateSpace& model, const StateMatrix& X) noexcept {
  const Eigen::Index n = X.rows();
  const double s = model.h.dot(X * model.h) + model.r;
  const StateVector gain = X * model.h / s;
  const StateMatrix keep = StateMatrix::Identity(n, n) - gain * model.h.transpose();
  const StateMatrix filtered = keep * X * keep.transpose() + model.r * gain * gain.transpose();
  return model.A * filtered * model.A.transpose() + model.Q;
}

/// Substitutes the answer back.
bool solves(const StateSpace& model, const StateMatrix& X) noexcept {
  constexpr double kTolerance = 1e-6;
  return (riccati_step(model, X) - X).norm() <= kTolerance * X.norm();
}

}  // namespace

bool solve_riccati(const StateSpace& model, StateMatrix& X) noexcept {
  constexpr int kMaxDoublings =
      40;  // 2^40 samples: longer than any mode within ArModel::kMaxRootRadius remembers
  constexpr double kSettled = 1e-14;
  assert(model.r > 0.0);
  const Eigen::Index n = model.A.rows();
  const StateMatrix identity = StateMatrix::Identity(n, n);
  StateMatrix a = model.A.transpose();
  StateMatrix G = model.h * model.h.transpose() / model.r;
  X = model.Q;
  for (int step = 0; step < kMaxDoublings; ++step) {
    const StateMatrix W = identity + G * X;
    const Eigen::PartialPivLU<StateMatrix> lu(W);
    const StateMatrix W_a = lu.solve(a);
    const StateMatrix W_G = lu.solve(G);
    const StateMatrix growth = W_a.transpose() * X * a;
    X += growth;
    X = (0.5 * (X + X.transpose())).eval();
    if (!X.allFinite()) return false;
    if (growth.norm() <= kSettled * X.norm()) return solves(model, X);
    G += a * W_G * a.transpose();
    G = (0.5 * (G + G.transpose())).eval();
    a = (a * W_a).eval();
  }
  return false;
}

}  // namespace gyrod::core
