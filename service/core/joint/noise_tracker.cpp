#include "core/joint/noise_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {
namespace {

/// Windows' lengths that are remembered.
constexpr double kMemory = 3.0;
/// A band this far above the believed noise holds motion. A level that is 20 % too low (1.56 in power), with a colour unknown to a
/// quarter, stays below it. Source: docs/method.md, "When the noise is not as believed".
constexpr double kMotion = 2.0;
/// A level above the believed one is taken for more than it shows, level^kExcessPower: the bands in which it shows most are left out as
/// motion, and a level that is too low costs several times what one costs that is too high.
constexpr double kExcessPower = 1.5;
/// Beyond these the noise is said to be wrong: the spread of level() on the right noise is 0.9 to 1.3.
constexpr double kTooQuiet = 0.8;
constexpr double kTooLoud = 1.4;
/// Mean of the least of kBands estimates of 1, each with the spread that three windows leave.
constexpr double kLeastOfBands = 0.93;

}  // namespace

void NoiseTracker::observe(std::span<const double> periodogram, std::span<const double> noise, bool known,
                           double share) noexcept {
  assert(periodogram.size() == noise.size() && periodogram.size() > kBands);
  if (known != known_) *this = {};
  known_ = known;
  weight_ = std::min(weight_ + share, kMemory);
  const double gain = std::min(share / weight_, 1.0);
  const std::size_t bins = periodogram.size() - 1;
  for (std::size_t band = 0; band < kBands; ++band) {
    const std::size_t begin = band * bins / kBands + 1;
    const std::size_t end = (band + 1) * bins / kBands + 1;
    double sum = 0.0;
    for (std::size_t k = begin; k < end; ++k) sum += periodogram[k] / noise[k];
    ratio_[band] += gain * (sum / static_cast<double>(end - begin) - ratio_[band]);
  }
}

double NoiseTracker::level() const noexcept {
  double sum = 0.0;
  double count = 0.0;
  for (const double ratio : ratio_) {
    if (ratio > kMotion) continue;
    sum += std::max(ratio, 1.0 / kMotion);
    count += 1.0;
  }
  if (count == 0.0) return 1.0;
  const double mean = sum / count;
  if (mean <= 1.0) return mean;
  return is_quiet() ? std::pow(mean, kExcessPower) : 1.0;
}

double NoiseTracker::floor() const noexcept { return std::ranges::min(ratio_) / kLeastOfBands; }

bool NoiseTracker::disagrees() const noexcept {
  return known_ && (level() < kTooQuiet || level() > kTooLoud);
}

bool NoiseTracker::is_quiet() const noexcept {
  const auto still = std::ranges::count_if(ratio_, [](double ratio) { return ratio <= kMotion; });
  return 2 * still > static_cast<std::ptrdiff_t>(kBands);
}

}  // namespace gyrod::core
