#include "core/allan/nonnegative_least_squares.hpp"

#include <bit>
#include <cassert>

#include <Eigen/QR>

namespace gyrod::core {
namespace {

Eigen::MatrixXd columns_in(const Eigen::MatrixXd& a, unsigned set) {
  Eigen::MatrixXd chosen(a.rows(), std::popcount(set));
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    if ((set >> i & 1U) != 0U) chosen.col(next++) = a.col(i);
  }
  return chosen;
}

Eigen::VectorXd spread(const Eigen::VectorXd& x, unsigned set, Eigen::Index size) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < size; ++i) {
    if ((set >> i & 1U) != 0U) all(i) = x(next++);
  }
  return all;
}

}  // namespace

Eigen::VectorXd nonnegative_least_squares(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                          const Eigen::Ref<const Eigen::VectorXd>& b, unsigned allowed) {
  assert(a.cols() <= 8 && a.rows() == b.size());
  const Eigen::VectorXd norms = a.colwise().norm();
  const Eigen::VectorXd scale = (norms.array() > 0.0).select(norms.cwiseInverse(), 0.0);
  const Eigen::MatrixXd scaled = a * scale.asDiagonal();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(a.cols());
  double least = b.squaredNorm();
  for (unsigned set = 1; set < 1U << a.cols(); ++set) {
    if ((set & ~allowed) != 0U || std::popcount(set) > a.rows()) continue;
    const Eigen::MatrixXd chosen = columns_in(scaled, set);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(chosen);
    if (qr.rank() < chosen.cols()) continue;
    const Eigen::VectorXd x = qr.solve(b);
    if (!(x.minCoeff() > 0.0)) continue;
    const double residual = (chosen * x - b).squaredNorm();
    if (residual >= least) continue;
    least = residual;
    best = spread(x, set, a.cols());
  }
  return best.cwiseProduct(scale);
}

}  // namespace gyrod::core
