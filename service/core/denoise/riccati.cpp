#include "core/denoise/riccati.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace gyrod::core {
namespace {

/// n x n, by rows, and a vector of n. The order n is known to the compiler where kSize is not 0 (several times faster), else it is up to kMaxArOrder.
/// Loops of our own: of a library's expressions this file took half a minute to compile.
template <class Scalar, std::size_t kSize>
class Doubling {
 public:
  explicit Doubling(const StateSpace& model)
      : n_(static_cast<std::size_t>(model.A.rows())), r_(static_cast<Scalar>(model.r)) {
    each([&](std::size_t i, std::size_t j) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto column = static_cast<Eigen::Index>(j);
      A_[i][j] = static_cast<Scalar>(model.A(row, column));
      Q_[i][j] = static_cast<Scalar>(model.Q(row, column));
      h_[i] = static_cast<Scalar>(model.h(row));
    });
  }

  [[nodiscard]] bool solve(StateMatrix& answer) noexcept {
    // 2^40 samples: longer than any mode within ArModel::kMaxRootRadius remembers.
    constexpr int kMaxDoublings = 40;
    constexpr Scalar kSettled = 1e-14;
    Matrix a = transposed(A_);
    Matrix G;
    each([&](std::size_t i, std::size_t j) { G[i][j] = h_[i] * h_[j] / r_; });
    Matrix X = Q_;
    for (int step = 0; step < kMaxDoublings; ++step) {
      Matrix W = times(G, X);
      for (std::size_t i = 0; i < n(); ++i) W[i][i] += Scalar(1);
      Matrix W_a = a;
      Matrix W_G = G;
      divide(W, W_a, W_G);
      const Matrix growth = times(times(transposed(W_a), X), a);
      each([&](std::size_t i, std::size_t j) { X[i][j] += growth[i][j]; });
      make_symmetric(X);
      const Scalar size = norm(X);
      if (!std::isfinite(size)) return false;
      if (norm(growth) <= kSettled * size) {
        answer.resize(static_cast<Eigen::Index>(n()), static_cast<Eigen::Index>(n()));
        each([&](std::size_t i, std::size_t j) {
          answer(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = static_cast<double>(X[i][j]);
        });
        return solves(X, size);
      }
      const Matrix more = times(times(a, W_G), transposed(a));
      each([&](std::size_t i, std::size_t j) { G[i][j] += more[i][j]; });
      make_symmetric(G);
      a = times(a, W_a);
    }
    return false;
  }

 private:
  static constexpr std::size_t kMost = kSize > 0 ? kSize : kMaxArOrder;
  using Vector = std::array<Scalar, kMost>;
  using Matrix = std::array<Vector, kMost>;

  [[nodiscard]] std::size_t n() const noexcept {
    if constexpr (kSize > 0) return kSize;
    return n_;
  }

  template <class Do>
  void each(const Do& element) const noexcept {
    for (std::size_t i = 0; i < n(); ++i) {
      for (std::size_t j = 0; j < n(); ++j) element(i, j);
    }
  }

  [[nodiscard]] Matrix times(const Matrix& left, const Matrix& right) const noexcept {
    Matrix product;
    for (std::size_t i = 0; i < n(); ++i) {
      for (std::size_t j = 0; j < n(); ++j) product[i][j] = left[i][0] * right[0][j];
      for (std::size_t k = 1; k < n(); ++k) {
        for (std::size_t j = 0; j < n(); ++j) product[i][j] += left[i][k] * right[k][j];
      }
    }
    return product;
  }

  [[nodiscard]] Matrix transposed(const Matrix& matrix) const noexcept {
    Matrix other;
    each([&](std::size_t i, std::size_t j) { other[i][j] = matrix[j][i]; });
    return other;
  }

  void make_symmetric(Matrix& matrix) const noexcept {
    for (std::size_t i = 0; i < n(); ++i) {
      for (std::size_t j = 0; j < i; ++j)
        matrix[i][j] = matrix[j][i] = Scalar(0.5) * (matrix[i][j] + matrix[j][i]);
    }
  }

  /// Frobenius; not finite where an element is not, or their squares overflow.
  [[nodiscard]] Scalar norm(const Matrix& matrix) const noexcept {
    Scalar squares = 0;
    each([&](std::size_t i, std::size_t j) { squares += matrix[i][j] * matrix[i][j]; });
    return std::sqrt(squares);
  }

  /// a <- W^-1 a, b <- W^-1 b, by elimination with row exchanges; W is used up.
  void divide(Matrix& W, Matrix& a, Matrix& b) const noexcept {
    for (std::size_t k = 0; k < n(); ++k) {
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n(); ++i) {
        if (std::abs(W[i][k]) > std::abs(W[pivot][k])) pivot = i;
      }
      std::swap(W[k], W[pivot]);
      std::swap(a[k], a[pivot]);
      std::swap(b[k], b[pivot]);
      for (std::size_t i = k + 1; i < n(); ++i) {
        const Scalar factor = W[i][k] / W[k][k];
        for (std::size_t j = k + 1; j < n(); ++j) W[i][j] -= factor * W[k][j];
        subtract(a[i], factor, a[k]);
        subtract(b[i], factor, b[k]);
      }
    }
    for (std::size_t k = n(); k-- > 0;) {
      for (std::size_t i = k + 1; i < n(); ++i) {
        subtract(a[k], W[k][i], a[i]);
        subtract(b[k], W[k][i], b[i]);
      }
      for (std::size_t j = 0; j < n(); ++j) {
        a[k][j] /= W[k][k];
        b[k][j] /= W[k][k];
      }
    }
  }

  void subtract(Vector& from, Scalar factor, const Vector& row) const noexcept {
    for (std::size_t j = 0; j < n(); ++j) from[j] -= factor * row[j];
  }

  /// Substitutes the answer back.
  [[nodiscard]] bool solves(const Matrix& X, Scalar size) const noexcept {
    // Of modes as smooth as splines rounding leaves 1e-6, in extended precision.
    constexpr Scalar kTolerance = 1e-5;
    Matrix rest = riccati_step(X);
    each([&](std::size_t i, std::size_t j) { rest[i][j] -= X[i][j]; });
    return norm(rest) <= kTolerance * size;
  }

  /// One step of the Riccati recursion, in Joseph form: symmetric and positive whatever the rounding.
  [[nodiscard]] Matrix riccati_step(const Matrix& X) const noexcept {
    Vector gain{};
    Scalar s = r_;
    for (std::size_t i = 0; i < n(); ++i) {
      for (std::size_t j = 0; j < n(); ++j) gain[i] += X[i][j] * h_[j];
      s += h_[i] * gain[i];
    }
    for (std::size_t i = 0; i < n(); ++i) gain[i] /= s;
    Matrix keep;
    each([&](std::size_t i, std::size_t j) { keep[i][j] = Scalar(i == j ? 1 : 0) - gain[i] * h_[j]; });
    Matrix filtered = times(times(keep, X), transposed(keep));
    each([&](std::size_t i, std::size_t j) { filtered[i][j] += r_ * gain[i] * gain[j]; });
    Matrix next = times(times(A_, filtered), transposed(A_));
    each([&](std::size_t i, std::size_t j) { next[i][j] += Q_[i][j]; });
    return next;
  }

  std::size_t n_;
  Matrix A_;
  Matrix Q_;
  Vector h_;
  Scalar r_;
};

}  // namespace

bool solve_riccati(const StateSpace& model, StateMatrix& X) noexcept {
  assert(model.r > 0.0);
  switch (model.A.rows()) {
    case 2:
      return Doubling<double, 2>(model).solve(X);
    case 3:
      return Doubling<double, 3>(model).solve(X);
    case 4:
      return Doubling<double, 4>(model).solve(X);
    case 5:
      return Doubling<double, 5>(model).solve(X);
    case 6:
      return Doubling<double, 6>(model).solve(X);  // the largest order by default
    default:
      return Doubling<double, 0>(model).solve(X);
  }
}

bool solve_riccati_precisely(const StateSpace& model, StateMatrix& X) noexcept {
  assert(model.r > 0.0);
  return Doubling<long double, 0>(model).solve(X);
}

}  // namespace gyrod::core
