#include "core/allan/allan_deviation.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/allan/degrees_of_freedom.hpp"
#include "core/signal/chi_squared.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kFewestSamples = 3;

/// x_0 .. x_N, x_k = sum of the first k rates less their mean: without it the sums grow and lose digits.
std::vector<double> sums_of(std::span<const double> rate) {
  std::vector<double> sums(rate.size() + 1, 0.0);
  const double centre = mean(rate);
  for (std::size_t n = 0; n < rate.size(); ++n) sums[n + 1] = sums[n] + (rate[n] - centre);
  return sums;
}

/// sum_k (x_{k+2m} - 2 x_{k+m} + x_k)^2 over all k: in eight partial sums, see signal/sums.hpp.
double sum_of_squares(std::span<const double> sums, std::size_t m) noexcept {
  using Pair = double __attribute__((vector_size(16)));
  constexpr std::size_t kPairs = 4;
  const std::size_t terms = sums.size() - 2 * m;
  const double* x = sums.data();
  const auto pair_at = [x](std::size_t n) {
    Pair pair;
    std::memcpy(&pair, x + n, sizeof pair);
    return pair;
  };
  std::array<Pair, kPairs> squares{};
  std::size_t k = 0;
  for (; k + 2 * kPairs <= terms; k += 2 * kPairs) {
    for (std::size_t i = 0; i < kPairs; ++i) {
      const std::size_t n = k + 2 * i;
      const Pair middle = pair_at(n + m);
      const Pair z = (pair_at(n + 2 * m) - middle) - (middle - pair_at(n));
      squares[i] += z * z;
    }
  }
  double rest = 0.0;
  for (; k < terms; ++k) {
    const double z = (x[k + 2 * m] - x[k + m]) - (x[k + m] - x[k]);
    rest += z * z;
  }
  const Pair sum = (squares[0] + squares[1]) + (squares[2] + squares[3]);
  return (sum[0] + sum[1]) + rest;
}

AllanPoint estimate(std::span<const double> sums, std::size_t m, double sample_rate_hz) noexcept {
  const double size = static_cast<double>(m);
  AllanPoint point;
  point.tau_s = size / sample_rate_hz;
  point.cluster_samples = m;
  point.terms = sums.size() - 2 * m;
  const double squares = sum_of_squares(sums, m);
  point.deviation = std::sqrt(squares / (2.0 * size * size * static_cast<double>(point.terms)));
  return point;
}

void add_interval(AllanPoint& point, PowerLaw noise, double confidence) noexcept {
  point.edf = equivalent_degrees_of_freedom(noise, point.cluster_samples, point.terms);
  const double tail = 0.5 * (1.0 - confidence);
  point.lower = point.deviation * std::sqrt(point.edf / chi_squared_quantile(1.0 - tail, point.edf));
  point.upper = point.deviation * std::sqrt(point.edf / chi_squared_quantile(tail, point.edf));
}

}  // namespace

std::vector<std::size_t> cluster_sizes(std::size_t samples, const AllanOptions& options) {
  assert(options.longest_part > 0.0 && options.longest_part <= 0.5);
  assert(options.points_per_decade >= 1 && options.points_per_decade <= 1000);
  std::vector<std::size_t> sizes;
  if (samples < kFewestSamples) return sizes;
  const double most = std::max(1.0, std::floor(options.longest_part * static_cast<double>(samples)));
  for (int i = 0;; ++i) {
    const double size = std::round(std::pow(10.0, static_cast<double>(i) / options.points_per_decade));
    if (size > most) return sizes;
    const auto m = static_cast<std::size_t>(size);
    if (sizes.empty() || sizes.back() < m) sizes.push_back(m);
  }
}

std::vector<AllanPoint> allan_deviation_at(std::span<const double> rate, double sample_rate_hz,
                                           std::span<const std::size_t> cluster_samples, double confidence) {
  assert(sample_rate_hz > 0.0 && confidence > 0.0 && confidence < 1.0);
  std::vector<AllanPoint> points;
  if (rate.size() < kFewestSamples) return points;
  const std::vector<double> sums = sums_of(rate);
  std::vector<double> work(rate.size());
  for (const std::size_t m : cluster_samples) {
    assert(m >= 1);
    if (m > rate.size() / 2) continue;
    AllanPoint point = estimate(sums, m, sample_rate_hz);
    // Too few clusters to tell the noise: it is taken for what it is at the longest time that does tell.
    const std::size_t telling = std::min(m, std::max<std::size_t>(1, rate.size() / kClustersToIdentify));
    const bool known = rate.size() / telling >= kClustersToIdentify;
    const PowerLaw noise = known ? identify_noise(sums, telling, work) : PowerLaw::kWhite;
    add_interval(point, noise, confidence);
    points.push_back(point);
  }
  return points;
}

std::vector<AllanPoint> allan_deviation(std::span<const double> rate, double sample_rate_hz,
                                        const AllanOptions& options) {
  const std::vector<std::size_t> sizes = cluster_sizes(rate.size(), options);
  return allan_deviation_at(rate, sample_rate_hz, sizes, options.confidence);
}

}  // namespace gyrod::core
