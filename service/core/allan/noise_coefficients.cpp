#include "core/allan/noise_coefficients.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/QR>

namespace gyrod::core {
namespace {

constexpr double kFloorPerBiasSquared = 2.0 * std::numbers::ln2 / std::numbers::pi;

}  // namespace

double variance_per_square(NoiseTerm term, double tau_s) noexcept {
  switch (term) {
    case NoiseTerm::kQuantization:
      return 3.0 / (tau_s * tau_s);
    case NoiseTerm::kAngleRandomWalk:
      return 1.0 / tau_s;
    case NoiseTerm::kBiasInstability:
      return kFloorPerBiasSquared;
    case NoiseTerm::kRateRandomWalk:
      return tau_s / 3.0;
    case NoiseTerm::kRateRamp:
      return tau_s * tau_s / 2.0;
  }
  return 0.0;
}

double model_deviation(const NoiseCoefficients& coefficients, double tau_s) noexcept {
  double variance = 0.0;
  for (std::size_t t = 0; t < kNoiseTerms; ++t) {
    const double value = coefficients.terms[t].value;
    variance += value * value * variance_per_square(static_cast<NoiseTerm>(t), tau_s);
  }
  return std::sqrt(variance);
}

double white_noise_per_sample(double angle_random_walk, double sample_rate_hz) noexcept {
  return angle_random_walk * std::sqrt(sample_rate_hz);
}

double random_walk_step_per_sample(double rate_random_walk, double sample_rate_hz) noexcept {
  return rate_random_walk / std::sqrt(sample_rate_hz);
}

double quantization_per_sample(double quantization, double sample_rate_hz) noexcept {
  return std::numbers::sqrt2 * quantization * sample_rate_hz;
}

double in_degrees_and_hours(NoiseTerm term, double value) noexcept {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  constexpr double kHour = 3600.0;
  constexpr double kRootHour = 60.0;
  switch (term) {
    case NoiseTerm::kQuantization:
      return value * kDegrees;
    case NoiseTerm::kAngleRandomWalk:
      return value * kDegrees * kRootHour;
    case NoiseTerm::kBiasInstability:
      return value * kDegrees * kHour;
    case NoiseTerm::kRateRandomWalk:
      return value * kDegrees * kHour * kRootHour;
    case NoiseTerm::kRateRamp:
      return value * kDegrees * kHour * kHour;
  }
  return value;
}

NoiseCoefficients polynomial_coefficients(std::span<const AllanPoint> points) {
  constexpr auto kFewest = kNoiseTerms + 1;
  constexpr auto kColumns = static_cast<Eigen::Index>(kNoiseTerms);
  if (points.size() < kFewest) return {};
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd powers(count, kColumns);
  Eigen::VectorXd deviation(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const AllanPoint& point = points[static_cast<std::size_t>(i)];
    deviation(i) = point.deviation;
    for (Eigen::Index n = 0; n < kColumns; ++n) {
      powers(i, n) = std::pow(point.tau_s, 0.5 * static_cast<double>(n - 2));
    }
  }
  // Columns of length 1, or tau^-1 and tau at long times differ by ten decades.
  const Eigen::VectorXd scale = powers.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = powers * scale.asDiagonal();
  const Eigen::VectorXd solution = scaled.colPivHouseholderQr().solve(deviation);
  const double residual =
      (scaled * solution - deviation).squaredNorm() / static_cast<double>(count - kColumns);
  const Eigen::MatrixXd inverse =
      (scaled.transpose() * scaled).ldlt().solve(Eigen::MatrixXd::Identity(kColumns, kColumns));
  NoiseCoefficients coefficients;
  for (Eigen::Index n = 0; n < kColumns; ++n) {
    // A term alone has sigma = coefficient * sqrt(variance_per_square): that at 1 s turns A_n into it.
    const double unit = std::sqrt(variance_per_square(static_cast<NoiseTerm>(n), 1.0));
    const double error = std::sqrt(std::max(0.0, residual * inverse(n, n)));
    coefficients.terms[static_cast<std::size_t>(n)] = {solution(n) * scale(n) / unit, error * scale(n) / unit,
                                                       true};
  }
  return coefficients;
}

}  // namespace gyrod::core
