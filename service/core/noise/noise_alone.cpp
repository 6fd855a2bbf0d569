#include "core/noise/noise_alone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/noise/same_noise.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kFewestBands = 3;
/// At so many times the frequency there is at least so much of the first band's density: motion falls off faster.
constexpr double kFaster = 1.5;
constexpr double kNotSteep = 0.3;
/// Of the band before the last has less, or there is next to nothing left of the flat part: no floor, as of white noise, under motion that falls off.
constexpr double kFallsOn = 0.75;
constexpr double kNextToNothing = 0.02;
/// Wider noise ends in a floor.
constexpr double kNarrowEnough = 0.7;
/// Ratio of two axes: at rest they differ by 1.5 (ADIS16405) to 2.2 (MPU6050).
constexpr double kOfASize = 3.0;
/// Ratio of the stretches in a band that chance does not explain.
constexpr double kSteadyBand = 1.2;
/// A band's least of a hundred lies so many standard deviations below its mean.
constexpr double kChanceOfLeast = 2.5;
constexpr double kOwn = 0.9;
/// Independent values of half overlapping segments, in parts of all.
constexpr double kIndependent = 0.6;

bool of_a_size(const AxisBands& bands, const NoiseAlone& found) noexcept {
  std::array<double, kSensorAxes> sum{};
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t band = found.first; band < bands.size(); ++band)
      sum[axis] += found.tells(band) ? bands.bins(band) * found.density[axis][band] : 0.0;
  }
  return std::ranges::max(sum) <= kOfASize * std::ranges::min(sum);
}

bool is_least(const AxisBands& bands, const NoiseAlone& found, const AxisBands::Axes& least) noexcept {
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    double now = 0.0;
    double seen = 0.0;
    for (std::size_t band = found.first; band < bands.size(); ++band) {
      if (!found.tells(band)) continue;
      now += bands.bins(band) * found.density[axis][band];
      const double chance = portable_exp(kChanceOfLeast / std::sqrt(bands.bins(band) * found.likeness.count));
      seen += bands.bins(band) * chance * least[axis][band];
    }
    if (now > kSameLevel * seen) return false;
  }
  return true;
}

bool is_steady(const AxisBands& bands, const NoiseAlone& found, const AxisDensities& before,
               const AxisDensities& now) noexcept {
  for (std::size_t band = found.first; band < bands.size(); ++band) {
    if (!found.tells(band)) continue;
    const double spread = 1.0 / before.count + 1.0 / now.count;
    const double most = kSteadyBand * bands.chance(band, 1.0 / spread);
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      const double ratio = now.own[axis][band] * before.count / (before.own[axis][band] * now.count);
      if (!(ratio <= most && 1.0 <= most * ratio)) return false;
    }
  }
  return true;
}

bool is_own(const AxisBands& bands, const NoiseAlone& found, const AxisDensities& before,
            const AxisDensities& now) noexcept {
  double own = 0.0;
  double all = 0.0;
  for (std::size_t band = found.first; band < bands.size(); ++band) {
    if (!found.tells(band)) continue;
    CrossPower power;
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      power.own[axis] = before.own[axis][band] + now.own[axis][band];
      power.shared[axis] = before.shared[axis][band] + now.shared[axis][band];
    }
    const double values = 2.0 * kIndependent * bands.bins(band) * (before.count + now.count);
    double least = 1.0;
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis)
      least = std::min(least, power.unexplained(axis, values));
    own += values * least;
    all += values;
  }
  return own >= kOwn * all;
}

bool falls_to_the_end(const AxisBands& bands, const NoiseAlone& found) noexcept {
  const AxisBands::Bands& middle = found.likeness.middle;
  const double last = middle[bands.size() - 1];
  return last < kFallsOn * middle[bands.size() - 2] || last < kNextToNothing * found.flat_density;
}

bool begins_flat(const AxisBands& bands, const NoiseAlone& found) noexcept {
  std::size_t faster = found.first;
  while (faster + 1 < bands.size() &&
         static_cast<double>(bands.edge(faster)) < kFaster * static_cast<double>(bands.edge(found.first)))
    ++faster;
  return found.likeness.middle[faster] > kNotSteep * found.likeness.middle[found.first];
}

bool has_shape(const AxisBands& bands, const NoiseAlone& found, std::size_t flat_end) noexcept {
  return begins_flat(bands, found) && bands.falls(found.likeness, flat_end) &&
         falls_to_the_end(bands, found) && bands.alike(found.likeness, found.flat_density) &&
         bands.bandwidth(found.likeness, found.flat_density) <= kNarrowEnough;
}

}  // namespace

std::optional<NoiseAlone> find_noise_alone(const AxisBands& bands, const AxisDensities& before,
                                           const AxisDensities& now, const AxisBands::Axes& least,
                                           double motion_bins) noexcept {
  NoiseAlone found;
  const double count = before.count + now.count;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t band = 0; band < bands.size(); ++band)
      found.density[axis][band] = (before.own[axis][band] + now.own[axis][band]) / count;
  }
  for (; found.first + kFewestBands <= bands.size(); ++found.first) {
    found.likeness = bands.compare(found.density, count, found.first);
    if (found.likeness.alive < kSensorAxes) break;
    const std::size_t flat_end = bands.flat_end(found.likeness);
    if (flat_end == 0) continue;
    found.flat_density = bands.mean_density(found.likeness.middle, found.first, flat_end);
    // Where this one is too low for the last to be a tenth of, faster ones are, too.
    if (!bands.ends_low(found.likeness, found.flat_density)) break;
    if (static_cast<double>(bands.edge(flat_end)) >= motion_bins && has_shape(bands, found, flat_end) &&
        of_a_size(bands, found) && is_least(bands, found, least) && is_steady(bands, found, before, now) &&
        is_own(bands, found, before, now))
      return found;
  }
  return std::nullopt;
}

}  // namespace gyrod::core
