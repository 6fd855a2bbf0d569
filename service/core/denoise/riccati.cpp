#include "core/denoise/riccati.hpp"

#include <cassert>

#include <Eigen/LU>

namespace gyrod::core {
namespace {

/// The solver for one matrix type: the same code for states whose size the compiler knows (several times faster) and for others.
template <class Matrix, class Vector>
class Doubling {
 public:
  using Scalar = typename Matrix::Scalar;

  explicit Doubling(const StateSpace& model)
      : A_(model.A.cast<Scalar>()), Q_(model.Q.cast<Scalar>()), h_(model.h.cast<Scalar>()), r_(model.r) {}

  [[nodiscard]] bool solve(StateMatrix& answer) noexcept {
    // 2^40 samples: longer than any mode within ArModel::kMaxRootRadius remembers.
    constexpr int kMaxDoublings = 40;
    constexpr Scalar kSettled = 1e-14;
    const Matrix identity = Matrix::Identity(A_.rows(), A_.cols());
    Matrix a = A_.transpose();
    Matrix G = h_ * h_.transpose() / r_;
    Matrix X = Q_;
    for (int step = 0; step < kMaxDoublings; ++step) {
      const Matrix W = identity + G * X;
      const Eigen::PartialPivLU<Matrix> lu(W);
      const Matrix W_a = lu.solve(a);
      const Matrix W_G = lu.solve(G);
      const Matrix growth = W_a.transpose() * X * a;
      X += growth;
      X = (Scalar(0.5) * (X + X.transpose())).eval();
      if (!X.allFinite()) return false;
      if (growth.norm() <= kSettled * X.norm()) {
        answer = X.template cast<double>();
        return solves(X);
      }
      G += a * W_G * a.transpose();
      G = (Scalar(0.5) * (G + G.transpose())).eval();
      a = (a * W_a).eval();
    }
    return false;
  }

 private:
  /// Substitutes the answer back.
  [[nodiscard]] bool solves(const Matrix& X) const noexcept {
    constexpr Scalar kTolerance = 1e-6;
    return (riccati_step(X) - X).norm() <= kTolerance * X.norm();
  }

  /// One step of the Riccati recursion, in Joseph form: symmetric and positive whatever the rounding.
  [[nodiscard]] Matrix riccati_step(const Matrix& X) const noexcept {
    const Scalar s = h_.dot(X * h_) + r_;
    const Vector gain = X * h_ / s;
    const Matrix keep = Matrix::Identity(X.rows(), X.cols()) - gain * h_.transpose();
    const Matrix filtered = keep * X * keep.transpose() + r_ * gain * gain.transpose();
    return A_ * filtered * A_.transpose() + Q_;
  }

  Matrix A_;
  Matrix Q_;
  Vector h_;
  Scalar r_;
};

template <int kSize>
bool solve_sized(const StateSpace& model, StateMatrix& X) noexcept {
  return Doubling<Eigen::Matrix<double, kSize, kSize>, Eigen::Matrix<double, kSize, 1>>(model).solve(X);
}

}  // namespace

bool solve_riccati(const StateSpace& model, StateMatrix& X) noexcept {
  assert(model.r > 0.0);
  switch (model.A.rows()) {
    case 2:
      return solve_sized<2>(model, X);
    case 3:
      return solve_sized<3>(model, X);
    case 4:
      return solve_sized<4>(model, X);
    case 5:
      return solve_sized<5>(model, X);
    case 6:
      return solve_sized<6>(model, X);  // the largest order by default
    default:
      return Doubling<StateMatrix, StateVector>(model).solve(X);
  }
}

bool solve_riccati_precisely(const StateSpace& model, StateMatrix& X) noexcept {
  assert(model.r > 0.0);
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxArOrder, kMaxArOrder>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1, 0, kMaxArOrder, 1>;
  return Doubling<Matrix, Vector>(model).solve(X);
}

}  // namespace gyrod::core
