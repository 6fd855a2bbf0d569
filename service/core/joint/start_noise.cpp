#include "core/joint/start_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gyrod::core {
namespace {

/// Variance of white noise's fourth differences in parts of its own: 8! / (4!)^2.
constexpr double kOfFourthDifferences = 70.0;
/// That many of them tell as much as one value that is independent of all others: 1 + 2 sum_k rho_k^2, rho = 56, 28, 8, 1 over 70.
constexpr double kDependent = 1.0 + 2.0 * (56.0 * 56.0 + 28.0 * 28.0 + 8.0 * 8.0 + 1.0) / (70.0 * 70.0);
/// So many independent values tell something beside two others.
constexpr double kFewest = 3.0;

}  // namespace

void StartNoise::step(const std::array<double, kSensorAxes>& sample) noexcept {
  std::array<double, kSensorAxes> difference = sample;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (double& last : last_[axis]) {
      const double next = difference[axis] - last;
      last = difference[axis];
      difference[axis] = next;
    }
  }
  if (++samples_ <= kOrder) return;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    power_.own[axis] += difference[axis] * difference[axis];
    power_.shared[axis] += difference[(axis + 1) % kSensorAxes] * difference[(axis + 2) % kSensorAxes];
  }
}

double StartNoise::most(std::size_t axis) const noexcept {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  if (samples_ <= kOrder) return kNoLimit;
  const auto count = static_cast<double>(samples_ - kOrder);
  const double independent = count / kDependent;
  if (independent < kFewest) return kNoLimit;
  std::array<double, kSensorAxes> own{};
  double least = kNoLimit;
  for (std::size_t i = 0; i < kSensorAxes; ++i) {
    own[i] = power_.unexplained(i, independent) * power_.own[i] / (count * kOfFourthDifferences);
    if (own[i] > 0.0) least = std::min(least, own[i]);
  }
  const double most = std::min(own[axis], kMostOfQuietest * least);
  return std::isfinite(most) && most > 0.0 ? most : kNoLimit;
}

}  // namespace gyrod::core
