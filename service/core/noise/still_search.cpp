#include "core/noise/still_search.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// Largest ratio of variances of one noise.
constexpr double kSameNoise = 1.5;
constexpr std::size_t kLookEvery = 1U << 16U;

/// A stretch with the mean of its windows' variances.
struct Measured {
  Stretch stretch;
  Triple variance{};
  double windows = 0.0;
};

/// Adds the window that ends before sample `end`.
void add_window(std::vector<Measured>& all, std::size_t end, const RestDetector& detector) {
  const std::size_t first = end - RestDetector::kBlocks * detector.block_samples();
  if (all.empty() || all.back().stretch.first + all.back().stretch.size < first) {
    all.push_back({.stretch = {first, 0}});
  }
  Measured& last = all.back();
  last.stretch.size = end - last.stretch.first;
  last.windows += 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    last.variance[axis] += (detector.variance()[axis] - last.variance[axis]) / last.windows;
  }
}

/// The least variance of each axis over all stretches.
Triple quietest(const std::vector<Measured>& all) {
  Triple least = all.front().variance;
  for (const Measured& one : all) {
    for (std::size_t axis = 0; axis < 3; ++axis) least[axis] = std::min(least[axis], one.variance[axis]);
  }
  return least;
}

void keep_quiet(const std::vector<Measured>& all, StillSearch& result) {
  if (all.empty()) return;
  const Triple least = quietest(all);
  for (const Measured& one : all) {
    bool loud = false;
    for (std::size_t axis = 0; axis < 3; ++axis) loud = loud || one.variance[axis] > kSameNoise * least[axis];
    (loud ? result.louder : result.still) += one.stretch.size;
    if (!loud) result.stretches.push_back(one.stretch);
  }
}

}  // namespace

StillSearch find_still(const StillInput& input, double sample_rate_hz,
                       const std::function<bool(double done)>& go_on) {
  RestDetector detector(sample_rate_hz);
  StillSearch result;
  std::vector<Measured> all;
  const std::size_t size = input.rate[0].size();
  const bool accelerated = !input.accelerometer[0].empty();
  for (std::size_t n = 0; n < size; ++n) {
    const auto at = [n](const auto& axes) { return Triple{axes[0][n], axes[1][n], axes[2][n]}; };
    const Triple force = accelerated ? at(input.accelerometer) : Triple{};
    const bool ended = detector.step(at(input.rate), accelerated ? &force : nullptr);
    ++result.verdicts[static_cast<std::size_t>(detector.verdict())];
    if (ended && detector.verdict() == RestVerdict::kRest) add_window(all, n + 1, detector);
    if (n % kLookEvery == 0 && go_on && !go_on(static_cast<double>(n) / static_cast<double>(size))) break;
  }
  keep_quiet(all, result);
  return result;
}

}  // namespace gyrod::core
