#include "core/noise/axis_spectra.hpp"

#include <algorithm>
#include <cmath>

#include "core/noise/spectrum_floor.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Logarithm of one in a hundred.
constexpr double kByChance = -4.605170185988091;

/// Coherence, in the mean of all bins.
constexpr double kCopies = 0.9;

/// Of AxisSpectra::cross.
constexpr std::size_t pair_of(std::size_t axis, std::size_t other) noexcept {
  return kSensorAxes - axis - other;
}

/// Coherence that so many segments of independent noise exceed by chance in one of a hundred: 1 - 0.01^(1 / (n - 1)).
/// Source: Carter, Knapp, Nuttall 1973, IEEE Trans. Audio Electroacoust. 21, 337.
double chance_coherence(double segments) noexcept {
  return segments > 1.0 ? 1.0 - portable_exp(kByChance / (segments - 1.0)) : 1.0;
}

}  // namespace

void AxisSums::add(const AxisTransforms& segment) noexcept {
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    const NoiseTransform& one = segment[next_axis(axis)];
    const NoiseTransform& other = segment[last_axis(axis)];
    for (std::size_t k = 0; k < kNoiseBins; ++k) {
      power[axis][k] += std::norm(segment[axis][k]);
      cross[axis][k] += std::complex(one[k].real() * other[k].real() + one[k].imag() * other[k].imag(),
                                     one[k].imag() * other[k].real() - one[k].real() * other[k].imag());
    }
  }
  count += 1.0;
}

void AxisSpectra::blend(const AxisSums& sums, const std::array<bool, kSensorAxes>& alive,
                        double most) noexcept {
  const auto mix = [&sums, most](double& weight, auto& average, const auto& added) {
    const double kept = std::min(weight, most - sums.count);
    weight = kept + sums.count;
    for (std::size_t k = 0; k < kNoiseBins; ++k) average[k] = (kept * average[k] + added[k]) / weight;
  };
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    if (alive[axis]) mix(segments[axis], power[axis], sums.power[axis]);
    if (alive[next_axis(axis)] && alive[last_axis(axis)])
      mix(cross_segments[axis], cross[axis], sums.cross[axis]);
  }
}

double AxisSpectra::shared(std::size_t axis, std::size_t first, std::size_t last) const noexcept {
  return std::max(shared_with(axis, next_axis(axis), first, last),
                  shared_with(axis, last_axis(axis), first, last));
}

double AxisSpectra::shared_apart(std::size_t axis, std::size_t first, std::size_t last) const noexcept {
  double most = 0.0;
  for (const std::size_t other : {next_axis(axis), last_axis(axis)}) {
    if (!are_copies(axis, other)) most = std::max(most, shared_with(axis, other, first, last));
  }
  return most;
}

double AxisSpectra::shared_with(std::size_t axis, std::size_t other, std::size_t first,
                                std::size_t last) const noexcept {
  const std::size_t pair = pair_of(axis, other);
  double common = 0.0;
  double all = 0.0;
  for (std::size_t k = first; k <= last; ++k) {
    common += std::norm(cross[pair][k]);
    all += power[axis][k] * power[other][k];
  }
  const double coherence = all > 0.0 ? common / all : 0.0;
  return coherence > chance_coherence(cross_segments[pair]) ? coherence : 0.0;
}

bool AxisSpectra::are_copies(std::size_t axis, std::size_t other) const noexcept {
  double coherence = 0.0;
  for (std::size_t k = kFirstNoiseBin; k < kNoiseBins; ++k) {
    const double all = power[axis][k] * power[other][k];
    if (all > 0.0) coherence += std::norm(cross[pair_of(axis, other)][k]) / all;
  }
  return coherence > kCopies * static_cast<double>(kNoiseBins - kFirstNoiseBin);
}

}  // namespace gyrod::core
