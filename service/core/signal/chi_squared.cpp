#include "core/signal/chi_squared.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <unsupported/Eigen/SpecialFunctions>

namespace gyrod::core {
namespace {

/// Wilson and Hilferty: (chi-squared / degrees)^(1/3) is nearly normal with these moments.
struct CubeRoot {
  explicit CubeRoot(double degrees) noexcept : variance(2.0 / (9.0 * degrees)), mean(1.0 - variance) {}
  double variance;
  double mean;
};

double normal_probability(double z) noexcept { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// The normal variable that x stands for.
double cube_root_normal(double x, double degrees) noexcept {
  const CubeRoot root(degrees);
  return (std::cbrt(x / degrees) - root.mean) / std::sqrt(root.variance);
}

double cube_root_quantile(double probability, double degrees) noexcept {
  const CubeRoot root(degrees);
  const double value = root.mean + Eigen::numext::ndtri(probability) * std::sqrt(root.variance);
  return degrees * value * value * value;
}

/// Ends of an interval that holds the quantile.
struct Bracket {
  double low = 0.0;
  double high = 0.0;
};

Bracket bracket_of(double probability, double degrees) noexcept {
  Bracket bracket{0.0, degrees + 1.0};
  while (chi_squared_probability(bracket.high, degrees) < probability) {
    bracket.low = bracket.high;
    bracket.high *= 2.0;
  }
  return bracket;
}

double density(double x, double degrees) noexcept {
  const double half = 0.5 * degrees;
  return 0.5 * std::exp((half - 1.0) * std::log(0.5 * x) - 0.5 * x - std::lgamma(half));
}

}  // namespace

double chi_squared_probability(double x, double degrees) noexcept {
  assert(degrees > 0.0 && x >= 0.0);
  if (degrees < kNormalFromDegrees) return Eigen::numext::igamma(0.5 * degrees, 0.5 * x);
  return normal_probability(cube_root_normal(x, degrees));
}

double chi_squared_tail(double x, double degrees) noexcept {
  assert(degrees > 0.0 && x >= 0.0);
  if (degrees < kNormalFromDegrees) return Eigen::numext::igammac(0.5 * degrees, 0.5 * x);
  return normal_probability(-cube_root_normal(x, degrees));
}

double chi_squared_quantile(double probability, double degrees) noexcept {
  assert(degrees > 0.0 && probability > 0.0 && probability < 1.0);
  if (degrees >= kNormalFromDegrees) return cube_root_quantile(probability, degrees);
  // Newton, kept inside a bracket by bisection: for few degrees the density is steep at 0.
  constexpr int kSteps = 200;
  constexpr double kTolerance = 1e-12;
  Bracket bracket = bracket_of(probability, degrees);
  double x = 0.5 * (bracket.low + bracket.high);
  for (int step = 0; step < kSteps; ++step) {
    const double excess = chi_squared_probability(x, degrees) - probability;
    (excess > 0.0 ? bracket.high : bracket.low) = x;
    double next = x - excess / density(x, degrees);
    if (!(next > bracket.low && next < bracket.high)) next = 0.5 * (bracket.low + bracket.high);
    const double change = std::abs(next - x);
    x = next;
    if (change <= kTolerance * x) break;
  }
  return x;
}

}  // namespace gyrod::core
