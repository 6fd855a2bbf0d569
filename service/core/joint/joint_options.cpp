#include "core/joint/joint_options.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Largest shrinkage, switching rate and correction rate; more was not measured.
constexpr double kMost = 0.1;

}  // namespace

JointScale::JointScale(double sample_rate_hz, std::size_t window_samples) noexcept {
  constexpr int kStepsPerOctave = 4;
  double ratio = 1.0;
  if (sample_rate_hz > 0.0 && std::isfinite(sample_rate_hz)) {
    const int steps = static_cast<int>(
        std::round(kStepsPerOctave * portable_log(sample_rate_hz / kDesignRateHz) / std::numbers::ln2));
    const double step = std::sqrt(std::numbers::sqrt2);  // roots and products are the same on every machine
    const int octaves = static_cast<int>(std::floor(static_cast<double>(steps) / kStepsPerOctave));
    ratio = std::ldexp(1.0, octaves);
    for (int k = kStepsPerOctave * octaves; k < steps; ++k) ratio *= step;
  }
  rate_ = ratio;
  faster_ = std::max(ratio, 1.0);
  const double window = static_cast<double>(kDesignWindowSamples) / static_cast<double>(window_samples);
  shorter_ = std::max(ratio * window, 1.0);
  fewer_ = std::max(window, 1.0);
}

double JointScale::switching_rate(double rate) const noexcept {
  return std::min(rate * fewer_ / faster_, kMost);
}

double JointScale::shrinkage(double shrinkage) const noexcept {
  return std::min(shrinkage * shorter_, kMost);
}

double JointScale::correction_rate(double rate) const noexcept {
  return std::min(rate * fewer_ / faster_, kMost);
}

}  // namespace gyrod::core
