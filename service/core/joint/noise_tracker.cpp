#include "core/joint/noise_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

/// Windows' lengths that are remembered.
constexpr double kMemory = 3.0;
/// A band this far above the believed noise holds motion. A level that is 20 % too low (1.56 in power), with a colour unknown to a
/// quarter, stays below it. Source: docs/method.md, "When the noise is not as believed".
constexpr double kMotion = 2.0;
/// Above the believed level, what the bands show is raised to these powers, their mean and the mean of the quietest three, and the smaller
/// is taken: the loudest bands are left out as motion, and a level too low costs several times what one too high costs; but vibration,
/// unlike noise, leaves some bands as they were.
constexpr double kMeanPower = 1.5;
constexpr double kQuietestPower = 6.0;
constexpr std::size_t kQuietest = 3;
/// Beyond these the noise is said to be wrong: the spread of level() on the right noise is 0.9 to 1.3.
constexpr double kTooQuiet = 0.8;
constexpr double kTooLoud = 1.4;
/// Where nothing is believed, bands up to so far above the quietest are noise as well: its colour. Source: docs/decisions/0006.
constexpr double kSameNoise = 2.5;
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
  std::array<double, kBands> sorted = ratio_;
  std::ranges::sort(sorted);
  const auto motion = std::ranges::find_if(sorted, [](double ratio) { return ratio > kMotion; });
  const std::span<const double> quiet{sorted.begin(), motion};
  if (quiet.empty()) return 1.0;
  const double all = mean(quiet);
  if (all <= 1.0) return std::max(all, 1.0 / kMotion);
  if (2 * quiet.size() <= kBands) return 1.0;
  const double quietest = mean(quiet.first(kQuietest));
  return std::max(1.0, std::min(std::pow(all, kMeanPower), std::pow(quietest, kQuietestPower)));
}

double NoiseTracker::floor() const noexcept {
  const double least = std::ranges::min(ratio_);
  double sum = 0.0;
  double count = 0.0;
  for (const double ratio : ratio_) {
    if (ratio > kSameNoise * least) continue;
    sum += ratio;
    count += 1.0;
  }
  return count > 0.0 ? std::max(sum / count, least / kLeastOfBands) : 0.0;
}

bool NoiseTracker::disagrees() const noexcept {
  return known_ && (level() < kTooQuiet || level() > kTooLoud);
}

}  // namespace gyrod::core
