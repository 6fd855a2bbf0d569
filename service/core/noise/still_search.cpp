#include "core/noise/still_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/noise/same_noise.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kLookEvery = 1U << 16U;

/// A stretch with the mean of its windows' variances.
struct Measured {
  Stretch stretch;
  Triple variance{};
  Triple mean{};
  double windows = 0.0;
};

/// Adds the window that ends before sample `end`. Windows of one run overlap; one that only touches the last is of a run of its own.
void add_window(std::vector<Measured>& all, std::size_t end, const RestDetector& detector) {
  const std::size_t first = end - RestDetector::kBlocks * detector.block_samples();
  if (all.empty() || all.back().stretch.first + all.back().stretch.size <= first) {
    all.push_back({.stretch = {first, 0}});
  }
  Measured& last = all.back();
  last.stretch.size = end - last.stretch.first;
  last.windows += 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    last.variance[axis] += (detector.variance()[axis] - last.variance[axis]) / last.windows;
    last.mean[axis] += (detector.mean()[axis] - last.mean[axis]) / last.windows;
  }
}

/// The least variance of each axis over all stretches in which it changes; 0 for one that never does.
Triple quietest(const std::vector<Measured>& all) {
  Triple least{};
  for (const Measured& one : all) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double variance = one.variance[axis];
      if (variance > 0.0 && (least[axis] == 0.0 || variance < least[axis])) least[axis] = variance;
    }
  }
  return least;
}

bool is_stuck(const Measured& one, const Triple& least) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (one.variance[axis] == 0.0 && least[axis] > 0.0) return true;
  }
  return false;
}

bool is_loud(const Measured& one, const Triple& least) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (one.variance[axis] > kSameLevel * least[axis]) return true;
  }
  return false;
}

/// The mean rate, axis by axis, that half of the samples are not above. @pre not empty
Triple usual_mean(std::vector<Measured> all) {
  std::size_t samples = 0;
  for (const Measured& one : all) samples += one.stretch.size;
  Triple usual{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::ranges::sort(all, {}, [axis](const Measured& one) { return one.mean[axis]; });
    std::size_t below = 0;
    for (const Measured& one : all) {
      usual[axis] = one.mean[axis];
      below += one.stretch.size;
      if (2 * below >= samples) break;
    }
  }
  return usual;
}

bool turns(const Measured& one, const Triple& usual) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(one.mean[axis] - usual[axis]) > kSameBias) return true;
  }
  return false;
}

void keep_still(const std::vector<Measured>& all, StillSearch& result) {
  const Triple least = quietest(all);
  std::vector<Measured> quiet;
  for (const Measured& one : all) {
    if (is_stuck(one, least))
      result.stuck += one.stretch.size;
    else if (is_loud(one, least))
      result.louder += one.stretch.size;
    else
      quiet.push_back(one);
  }
  if (quiet.empty()) return;
  const Triple usual = usual_mean(quiet);
  for (const Measured& one : quiet) {
    (turns(one, usual) ? result.turning : result.still) += one.stretch.size;
    if (!turns(one, usual)) result.stretches.push_back(one.stretch);
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
    const bool bridged = !input.bridged.empty() && input.bridged[n] != 0;
    const Triple* accelerometer = accelerated ? &force : nullptr;
    const bool ended = bridged ? detector.bridge(at(input.rate), accelerometer)
                               : detector.step(at(input.rate), accelerometer);
    ++result.verdicts[static_cast<std::size_t>(detector.verdict())];
    if (ended && detector.verdict() == RestVerdict::kRest) add_window(all, n + 1, detector);
    if (n % kLookEvery == 0 && go_on && !go_on(static_cast<double>(n) / static_cast<double>(size))) break;
  }
  keep_still(all, result);
  return result;
}

}  // namespace gyrod::core
