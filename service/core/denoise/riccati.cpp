#include "core/denoise/riccati.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include <Eigen/Core>

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
      Matrix W_a = a;
      Matrix W_G = G;
      divide(identity + product(G, X), W_a, W_G);
      const Matrix growth = product(product(W_a.transpose(), X), a);
      X = mean_of_triangles(X + growth);
      if (!X.allFinite()) return false;
      if (growth.norm() <= kSettled * X.norm()) {
        answer = X.template cast<double>();
        return solves(X);
      }
      G = mean_of_triangles(G + product(product(a, W_G), a.transpose()));
      a = product(a, W_a);
    }
    return false;
  }

 private:
  // Small products and sums that Eigen writes out element by element: once, not in every place, or this file takes minutes to compile.
  [[gnu::noinline]] static Matrix product(const Matrix& a, const Matrix& b) noexcept { return a * b; }
  [[gnu::noinline]] static Matrix mean_of_triangles(const Matrix& X) noexcept {
    return Scalar(0.5) * (X + X.transpose());
  }

  /// a <- W^-1 a and G <- W^-1 G by elimination, the largest element of the column leading. A singular W leaves what is not finite.
  [[gnu::noinline]] static void divide(Matrix W, Matrix& a, Matrix& G) noexcept {
    const Eigen::Index size = W.rows();
    for (Eigen::Index k = 0; k < size; ++k) {
      Eigen::Index pivot = k;
      for (Eigen::Index i = k + 1; i < size; ++i) {
        if (std::abs(W(i, k)) > std::abs(W(pivot, k))) pivot = i;
      }
      if (pivot != k) {
        for (Matrix* matrix : {&W, &a, &G}) exchange_rows(*matrix, pivot, k);
      }
      for (Eigen::Index i = k + 1; i < size; ++i) {
        const Scalar factor = W(i, k) / W(k, k);
        for (Matrix* matrix : {&W, &a, &G}) subtract_row(*matrix, factor, k, i);
      }
    }
    for (Eigen::Index k = size; k-- > 0;) {
      const Scalar inverse = Scalar(1) / W(k, k);
      for (Matrix* matrix : {&a, &G}) {
        for (Eigen::Index j = 0; j < size; ++j) (*matrix)(k, j) *= inverse;
        for (Eigen::Index i = 0; i < k; ++i) subtract_row(*matrix, W(i, k), k, i);
      }
    }
  }

  /// row_to -= factor * row_from.
  static void subtract_row(Matrix& matrix, Scalar factor, Eigen::Index from, Eigen::Index to) noexcept {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) matrix(to, j) -= factor * matrix(from, j);
  }

  static void exchange_rows(Matrix& matrix, Eigen::Index i, Eigen::Index k) noexcept {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) std::swap(matrix(i, j), matrix(k, j));
  }

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
    const Matrix filtered = product(product(keep, X), keep.transpose()) + r_ * gain * gain.transpose();
    return product(product(A_, filtered), A_.transpose()) + Q_;
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
