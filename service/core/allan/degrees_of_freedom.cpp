#include "core/allan/degrees_of_freedom.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

constexpr double kStepsPerCluster = 64.0;
/// Beyond four clusters rho is 0, for flicker below 0.03: its square is left out.
constexpr double kFarthestLag = 4.0;

/// Lag-1 autocorrelation; 0 for a constant sequence.
double lag_1(std::span<const double> x) noexcept {
  const double centre = mean(x);
  double products = 0.0;
  double squares = 0.0;
  for (std::size_t n = 0; n < x.size(); ++n) {
    squares += (x[n] - centre) * (x[n] - centre);
    if (n > 0) products += (x[n] - centre) * (x[n - 1] - centre);
  }
  return squares > 0.0 ? products / squares : 0.0;
}

double power_law_exponent(std::span<double> means) noexcept {
  constexpr double kStationaryBelow = 0.25;
  constexpr int kMostDifferences = 2;
  for (int differences = 0;; ++differences) {
    const double r = lag_1(means);
    const double delta = r / (1.0 + r);
    if (delta < kStationaryBelow || differences == kMostDifferences) return -2.0 * (delta + differences);
    for (std::size_t n = 0; n + 1 < means.size(); ++n) means[n] = means[n + 1] - means[n];
    means = means.first(means.size() - 1);
  }
}

/// s(u) without its constant factor.
double generalised_autocovariance(PowerLaw noise, double u) noexcept {
  const double a = std::abs(u);
  if (noise == PowerLaw::kRandomWalk) return a * a * a;
  if (noise == PowerLaw::kFlicker) return a > 0.0 ? a * a * std::log(a) : 0.0;
  return -a;
}

double autocovariance(PowerLaw noise, double u) noexcept {
  const auto s = [noise](double lag) { return generalised_autocovariance(noise, lag); };
  return 6.0 * s(u) - 4.0 * s(u + 1.0) - 4.0 * s(u - 1.0) + s(u + 2.0) + s(u - 2.0);
}

/// sum_{|l|<M} (1 - |l|/M) rho^2 where only x_k itself is common to z_k, z_{k+m} and z_{k+2m}.
double quantization_sum(double m, double terms) noexcept {
  constexpr double kRho1 = -4.0 / 6.0;
  constexpr double kRho2 = 1.0 / 6.0;
  return 1.0 + 2.0 * std::max(0.0, 1.0 - m / terms) * kRho1 * kRho1 +
         2.0 * std::max(0.0, 1.0 - 2.0 * m / terms) * kRho2 * kRho2;
}

double correlated_sum(PowerLaw noise, double m, double terms) noexcept {
  const double step = std::max(1.0, std::min(m, terms) / kStepsPerCluster);
  const double at_zero = autocovariance(noise, 0.0);
  double sum = 0.5;
  const double end = std::min(terms, kFarthestLag * m);
  for (std::size_t i = 1; step * static_cast<double>(i) < end; ++i) {
    const double lag = step * static_cast<double>(i);
    const double rho = autocovariance(noise, lag / m) / at_zero;
    sum += (1.0 - lag / terms) * rho * rho;
  }
  return 2.0 * step * sum;
}

}  // namespace

PowerLaw identify_noise(std::span<const double> sums, std::size_t cluster_samples,
                        std::span<double> work) noexcept {
  const std::size_t clusters = (sums.size() - 1) / cluster_samples;
  assert(clusters >= kClustersToIdentify && work.size() >= clusters);
  for (std::size_t i = 0; i < clusters; ++i) {
    work[i] = sums[(i + 1) * cluster_samples] - sums[i * cluster_samples];
  }
  const double alpha = power_law_exponent(work.first(clusters));
  if (alpha >= 1.5) return PowerLaw::kQuantization;
  if (alpha >= -0.5) return PowerLaw::kWhite;
  return alpha >= -1.5 ? PowerLaw::kFlicker : PowerLaw::kRandomWalk;
}

double equivalent_degrees_of_freedom(PowerLaw noise, std::size_t cluster_samples,
                                     std::size_t terms) noexcept {
  assert(cluster_samples >= 1 && terms >= 1);
  const double m = static_cast<double>(cluster_samples);
  const double count = static_cast<double>(terms);
  const double sum =
      noise == PowerLaw::kQuantization ? quantization_sum(m, count) : correlated_sum(noise, m, count);
  return std::max(1.0, count / sum);
}

}  // namespace gyrod::core
