// The primary fit: non-negative least squares on the variance.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "core/allan/noise_coefficients.hpp"
#include "core/allan/nonnegative_least_squares.hpp"
#include "core/allan/point_correlation.hpp"

namespace gyrod::core {
namespace {

constexpr double kMisfit = 0.05;
constexpr double kSignificant = 2.5;
constexpr double kFar = 2.0;
constexpr std::size_t kFewestPoints = 3;
constexpr unsigned kAllTerms = (1U << kNoiseTerms) - 1U;
constexpr auto kTerms = static_cast<Eigen::Index>(kNoiseTerms);

/// A bit for each term.
unsigned mask_of(const std::vector<Eigen::Index>& terms) {
  unsigned mask = 0;
  for (const Eigen::Index term : terms) mask |= 1U << term;
  return mask;
}

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

/// Distance of the points from the model in their standard deviations.
Eigen::ArrayXd distances_of(const Curve& curve, const Eigen::VectorXd& model) {
  return (curve.variance - model).array() / (model.array() * curve.spread.array());
}

/// What a point counts: 1, and less where it is far from the model. Source: Huber 1964.
Eigen::ArrayXd trust_in(const Curve& curve, const Eigen::VectorXd& model) {
  return (kFar / distances_of(curve, model).abs().max(kFar)).sqrt();
}

/// Q^2 .. R^2, those outside of `allowed` 0.
Eigen::VectorXd fit_squares(const Curve& curve, unsigned allowed) {
  constexpr int kIterations = 50;
  constexpr double kSettled = 1e-10;
  Eigen::VectorXd model = curve.variance;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(kTerms);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXd weights = trust_in(curve, model) / (model.array() * curve.spread.array());
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

/// Covariance of the points in their standard deviations, diagonal 1: chance by the spectrum of the model; the
/// misfit of neighbours within about an octave is the same.
Eigen::MatrixXd covariance_of(const Curve& curve, const Eigen::VectorXd& squares) {
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

/// Squares by linear least squares on the terms of `used`, and their standard errors.
struct Estimate {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(kTerms);
  Eigen::VectorXd error = Eigen::VectorXd::Zero(kTerms);
  double widening = 1.0;  ///< residuals over what the points' covariance explains, at least 1
};

/// @param truth  squares that weights and covariance are made with
/// @param trust  of the points
Estimate estimate(const Curve& curve, const std::vector<Eigen::Index>& used, const Eigen::VectorXd& truth,
                  const Eigen::ArrayXd& trust) {
  const Eigen::VectorXd model = curve.basis * truth;
  const Eigen::VectorXd weights = trust / (model.array() * curve.spread.array());
  const Eigen::MatrixXd weighted = weights.asDiagonal() * curve.basis(Eigen::all, used);
  const Eigen::VectorXd scale = weighted.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd columns = weighted * scale.asDiagonal();
  const Eigen::MatrixXd solver = (columns.transpose() * columns).inverse() * columns.transpose();
  const Eigen::MatrixXd covariance =
      trust.matrix().asDiagonal() * covariance_of(curve, truth) * trust.matrix().asDiagonal();
  const Eigen::VectorXd value = solver * weights.cwiseProduct(curve.variance);
  const Eigen::MatrixXd spread = solver * covariance * solver.transpose();
  Estimate result;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    result.value(used[i]) = value(at) * scale(at);
    result.error(used[i]) = std::sqrt(spread(at, at)) * scale(at);
  }
  const double expected = (covariance - columns * (solver * covariance)).trace();
  const double residual = distances_of(curve, model).abs().min(kFar).square().sum();
  if (expected > 0.0) result.widening = std::max(1.0, std::sqrt(residual / expected));
  return result;
}

/// A fit on some of the terms.
struct Fit {
  Fit(const Curve& curve, unsigned allowed) : squares(fit_squares(curve, allowed)) {
    for (Eigen::Index t = 0; t < kTerms; ++t) {
      if (squares(t) > 0.0) used.push_back(t);
    }
    if (used.empty()) return;
    trust = trust_in(curve, curve.basis * squares);
    errors = estimate(curve, used, squares, trust);
  }

  Eigen::VectorXd squares;
  std::vector<Eigen::Index> used;
  Eigen::ArrayXd trust;
  Estimate errors;
};

/// How many standard errors a term's square would stand above 0 if the truth were without it (a score test: the
/// error at the estimate itself grows with the estimate and would hide a term that towers over the rest).
double significance(const Curve& curve, const Fit& fit, Eigen::Index term) {
  const Eigen::VectorXd without = fit_squares(curve, mask_of(fit.used) & ~(1U << term));
  const Estimate test = estimate(curve, fit.used, without, fit.trust);
  return test.value(term) / (test.error(term) * fit.errors.widening);
}

/// The least significant term; nothing where all of them are significant, or only one is left.
std::optional<Eigen::Index> weakest_term(const Curve& curve, const Fit& fit) {
  std::optional<Eigen::Index> weakest;
  if (fit.used.size() < 2) return weakest;
  double least = kSignificant;
  for (const Eigen::Index term : fit.used) {
    const double ratio = significance(curve, fit, term);
    if (ratio >= least) continue;
    least = ratio;
    weakest = term;
  }
  return weakest;
}

/// From squares to coefficients: d sqrt(s) = ds / (2 sqrt(s)). How far the dropped terms had held a value elsewhere
/// is part of its error: they may be there all the same.
NoiseCoefficients roots_of(const Fit& fit, const Fit& with_all_terms) {
  NoiseCoefficients coefficients;
  for (const Eigen::Index term : fit.used) {
    const double value = std::sqrt(fit.squares(term));
    const double chance = fit.errors.error(term) * fit.errors.widening / (2.0 * value);
    const double shift = std::sqrt(with_all_terms.squares(term)) - value;
    coefficients.terms[static_cast<std::size_t>(term)] = {value, std::hypot(chance, shift), true};
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
  const Fit with_all_terms(curve, kAllTerms);
  Fit fit = with_all_terms;
  while (const auto weakest = weakest_term(curve, fit)) {
    fit = Fit(curve, mask_of(fit.used) & ~(1U << *weakest));
  }
  return roots_of(fit, with_all_terms);
}

}  // namespace gyrod::core
