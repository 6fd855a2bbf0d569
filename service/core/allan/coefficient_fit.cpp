// The primary fit: non-negative least squares on the variance.
#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/allan/noise_coefficients.hpp"
#include "core/allan/nonnegative_least_squares.hpp"
#include "core/allan/point_correlation.hpp"

namespace gyrod::core {
namespace {

constexpr double kMisfit = 0.05;
constexpr double kSignificant = 3.0;
constexpr std::size_t kFewestPoints = 3;
constexpr auto kTerms = static_cast<Eigen::Index>(kNoiseTerms);

/// The points as the fit sees them.
struct Curve {
  explicit Curve(std::vector<AllanPoint> usable) : points(std::move(usable)) {
    const auto count = static_cast<Eigen::Index>(points.size());
    variance.resize(count);
    chance.resize(count);
    basis.resize(count, kTerms);
    for (Eigen::Index i = 0; i < count; ++i) {
      const AllanPoint& point = points[static_cast<std::size_t>(i)];
      variance(i) = point.deviation * point.deviation;
      chance(i) = 2.0 / point.edf;
      for (Eigen::Index t = 0; t < kTerms; ++t) {
        basis(i, t) = variance_per_square(static_cast<NoiseTerm>(t), point.tau_s);
      }
    }
    spread = (chance.array() + kMisfit * kMisfit).sqrt();
  }

  std::vector<AllanPoint> points;
  Eigen::VectorXd variance;
  Eigen::VectorXd chance;  ///< relative variance of a point by chance, 2/edf
  Eigen::VectorXd spread;  ///< relative standard deviation of a point, chance and misfit
  Eigen::MatrixXd basis;   ///< variance_per_square()
};

/// Squares of the coefficients, and their standard errors.
struct Squares {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(kTerms);
  Eigen::VectorXd error = Eigen::VectorXd::Zero(kTerms);
};

/// One over the standard deviation of each point where the model is the truth.
Eigen::VectorXd weights_of(const Curve& curve, const Eigen::VectorXd& model) {
  return model.cwiseProduct(curve.spread).cwiseInverse();
}

Eigen::VectorXd fit_squares(const Curve& curve, unsigned allowed) {
  constexpr int kIterations = 50;
  constexpr double kSettled = 1e-10;
  Eigen::VectorXd model = curve.variance;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(kTerms);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd weights = weights_of(curve, model);
    squares = nonnegative_least_squares(weights.asDiagonal() * curve.basis,
                                        weights.cwiseProduct(curve.variance), allowed);
    const Eigen::VectorXd next = curve.basis * squares;
    if (!(next.minCoeff() > 0.0)) break;
    const double change = ((next - model).array() / next.array()).abs().maxCoeff();
    model = next;
    if (change < kSettled) break;
  }
  return squares;
}

/// Covariance of the weighted points, diagonal 1: chance by the spectrum of the model; the misfit of neighbours
/// within about an octave is the same.
Eigen::MatrixXd weighted_covariance(const Curve& curve, const Eigen::VectorXd& squares) {
  std::array<double, kNoiseTerms> model{};
  std::copy_n(squares.data(), kNoiseTerms, model.begin());
  Eigen::MatrixXd covariance = point_correlation(curve.points, model);
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j) {
      const double ratio = static_cast<double>(curve.points[static_cast<std::size_t>(i)].cluster_samples) /
                           static_cast<double>(curve.points[static_cast<std::size_t>(j)].cluster_samples);
      const double chance = covariance(i, j) * std::sqrt(curve.chance(i) * curve.chance(j));
      const double misfit = kMisfit * kMisfit * std::exp(-std::abs(std::log2(ratio)));
      covariance(i, j) = (chance + misfit) / (curve.spread(i) * curve.spread(j));
    }
  }
  return covariance;
}

/// Standard errors of the squares above 0, by the covariance of the points; wider where the residuals are larger
/// than that explains.
Squares with_errors(const Curve& curve, const Eigen::VectorXd& squares) {
  Squares result{squares, Eigen::VectorXd::Zero(kTerms)};
  std::vector<Eigen::Index> used;
  for (Eigen::Index t = 0; t < kTerms; ++t) {
    if (squares(t) > 0.0) used.push_back(t);
  }
  if (used.empty()) return result;
  const Eigen::VectorXd weights = weights_of(curve, curve.basis * squares);
  // Unknowns in units of their estimates: columns of comparable size.
  const Eigen::MatrixXd columns =
      weights.asDiagonal() * curve.basis(Eigen::all, used) * Eigen::VectorXd(squares(used)).asDiagonal();
  const Eigen::MatrixXd solver = (columns.transpose() * columns).inverse() * columns.transpose();
  const Eigen::MatrixXd covariance = weighted_covariance(curve, squares);
  const Eigen::VectorXd residual =
      weights.cwiseProduct(curve.variance) - columns * Eigen::VectorXd::Ones(columns.cols());
  const Eigen::MatrixXd left = covariance - columns * (solver * covariance);
  const double expected = left.trace();
  const double widening = expected > 0.0 ? std::max(1.0, residual.squaredNorm() / expected) : 1.0;
  const Eigen::MatrixXd relative = widening * solver * covariance * solver.transpose();
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.error(used[i]) = squares(used[i]) * std::sqrt(relative(at, at));
  }
  return result;
}

/// The term with the least value over error; nothing to drop where all are significant.
int least_significant(const Squares& squares) {
  int least = -1;
  double least_ratio = kSignificant;
  for (int t = 0; t < static_cast<int>(kTerms); ++t) {
    if (!(squares.value(t) > 0.0)) continue;
    const double ratio = squares.value(t) / squares.error(t);
    if (ratio >= least_ratio) continue;
    least_ratio = ratio;
    least = t;
  }
  return least;
}

/// From a square to the coefficient: d sqrt(s) = ds / (2 sqrt(s)).
NoiseCoefficients roots_of(const Squares& squares) {
  NoiseCoefficients coefficients;
  for (std::size_t t = 0; t < kNoiseTerms; ++t) {
    const auto at = static_cast<Eigen::Index>(t);
    if (!(squares.value(at) > 0.0)) continue;
    const double value = std::sqrt(squares.value(at));
    coefficients.terms[t] = {value, squares.error(at) / (2.0 * value), true};
  }
  return coefficients;
}

}  // namespace

NoiseCoefficients fit_coefficients(std::span<const AllanPoint> points) {
  std::vector<AllanPoint> usable;
  std::ranges::copy_if(points, std::back_inserter(usable),
                       [](const AllanPoint& point) { return point.deviation > 0.0; });
  if (usable.size() < kFewestPoints) return {};
  const Curve curve(std::move(usable));
  unsigned allowed = (1U << kNoiseTerms) - 1U;
  while (allowed != 0U) {
    const Squares squares = with_errors(curve, fit_squares(curve, allowed));
    const int weakest = least_significant(squares);
    if (weakest < 0) return roots_of(squares);
    allowed &= ~(1U << weakest);
  }
  return {};
}

}  // namespace gyrod::core
