#include "core/noise/axis_bands.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/noise/spectrum_floor.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Bands end a quarter above where they begin, two bins at least.
constexpr std::size_t kBandWidth = 4;
constexpr std::size_t kFewestBins = 2;
/// What is left of the spectrum after the last band, up to so many bins, is part of it.
constexpr std::size_t kFewestLastBins = 10;
/// Of the flat part: less than this in a band that chance does not explain ends it.
constexpr double kEndOfFlat = 0.75;
/// Of what is slower: filters ring a little.
constexpr double kRises = 1.15;
/// Of the flat part: the last band has less, and axes are not compared where there is less.
constexpr double kFallen = 0.1;
/// Ratio of one axis to the middle one: parts and their colours differ.
constexpr double kAlike = 1.2;
/// An axis may have a line of its own: louder in so many bands.
constexpr std::size_t kMostLouderBands = 2;
/// Standard deviations of a band's mean that count as chance.
constexpr double kChance = 4.0;
/// Efficiency of the median of three against their mean: 0.74, and half overlapping segments have a little less than they would apart.
constexpr double kMedian = 0.6;

constexpr double kSegmentsOfHalf = 4.0;
constexpr double kSecondsOfHalf = 4.0;

}  // namespace

double segments_of_half(double sample_rate_hz) noexcept {
  return std::max(kSegmentsOfHalf,
                  std::ceil(kSecondsOfHalf * sample_rate_hz / static_cast<double>(kSegmentHop)));
}

AxisBands::AxisBands() noexcept {
  edges_[0] = kFirstNoiseBin;
  while (edges_[size_] < kNoiseBins) {
    const std::size_t first = edges_[size_];
    const std::size_t end = first + std::max(kFewestBins, first / kBandWidth);
    edges_[++size_] = end + kFewestLastBins > kNoiseBins ? kNoiseBins : end;
    assert(size_ <= kMost);
  }
}

void AxisBands::add(const NoiseSpectrum& power, Bands& sums) const noexcept {
  for (std::size_t band = 0; band < size_; ++band) {
    double sum = 0.0;
    for (std::size_t k = edges_[band]; k < edges_[band + 1]; ++k) sum += power[k];
    sums[band] += sum / bins(band);
  }
}

AxisBands::Likeness AxisBands::compare(const Axes& sums, double count, std::size_t first) const noexcept {
  Likeness result;
  result.count = count;
  result.first = first;
  for (const Bands& axis : sums) {
    Bands& bands = result.axes[result.alive];
    bands = axis;
    const double mean = mean_density(bands, first, size_);
    if (!(mean > 0.0) || !std::isfinite(mean)) continue;
    for (double& density : bands) density /= mean;
    ++result.alive;
  }
  if (result.alive < 2) return result;
  result.spectra = kMedian * count * static_cast<double>(result.alive);
  find_middle(result);
  for (std::size_t axis = 0; axis < result.alive; ++axis) scale_to_middle(result.axes[axis], result);
  find_middle(result);
  return result;
}

/// Band by band the middle one of three axes, the mean of two.
void AxisBands::find_middle(Likeness& likeness) const noexcept {
  const auto& [x, y, z] = likeness.axes;
  for (std::size_t band = likeness.first; band < size_; ++band) {
    likeness.middle[band] = likeness.alive < 3 ? 0.5 * (x[band] + y[band])
                                               : std::max(std::min(x[band], y[band]),
                                                          std::min(std::max(x[band], y[band]), z[band]));
  }
}

/// By the middle one of their ratios in the bands that have power.
void AxisBands::scale_to_middle(Bands& axis, const Likeness& likeness) const noexcept {
  const Bands& middle = likeness.middle;
  const double loud = kFallen * *std::max_element(middle.begin() + likeness.first, middle.begin() + size_);
  Bands ratios{};
  std::size_t count = 0;
  for (std::size_t band = likeness.first; band < size_; ++band) {
    if (middle[band] > loud) ratios[count++] = axis[band] / middle[band];
  }
  const auto centre = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ratios.begin(), centre, ratios.begin() + static_cast<std::ptrdiff_t>(count));
  if (!(*centre > 0.0)) return;
  for (double& density : axis) density /= *centre;
}

double AxisBands::bandwidth(const Likeness& likeness, double density) const noexcept {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t band = 0; band < size_; ++band) {
    const double here = band < likeness.first ? density : likeness.middle[band];
    sum += bins(band) * here;
    squares += bins(band) * here * here;
    count += bins(band);
  }
  return std::min(sum * sum / (count * squares), 1.0);
}

std::size_t AxisBands::flat_end(const Likeness& likeness) const noexcept {
  for (std::size_t flat = likeness.first + 1; flat < size_; ++flat) {
    const double density = mean_density(likeness.middle, likeness.first, flat);
    const double chance_of = chance(flat, likeness.spectra);
    if (likeness.middle[flat] * std::sqrt(chance_of) < kEndOfFlat * density) return flat;
    if (likeness.middle[flat] > kRises * chance_of * density) return 0;
  }
  return size_;
}

bool AxisBands::falls(const Likeness& likeness, std::size_t flat_end) const noexcept {
  for (std::size_t band = flat_end + 1; band < size_; ++band) {
    if (likeness.middle[band] > kRises * chance(band, likeness.spectra) * likeness.middle[band - 1])
      return false;
  }
  return ends_low(likeness, mean_density(likeness.middle, likeness.first, flat_end));
}

bool AxisBands::ends_low(const Likeness& likeness, double flat_density) const noexcept {
  return likeness.middle[size_ - 1] < kFallen * flat_density;
}

bool AxisBands::tells(const Likeness& likeness, std::size_t band, double flat_density) noexcept {
  return band >= likeness.first && likeness.middle[band] >= kFallen * flat_density;
}

bool AxisBands::alike(const Likeness& likeness, double flat_density) const noexcept {
  for (std::size_t axis = 0; axis < likeness.alive; ++axis) {
    std::size_t louder = 0;
    for (std::size_t band = likeness.first; band < size_; ++band) {
      const double own = likeness.axes[axis][band];
      const double middle = likeness.middle[band];
      if (!tells(likeness, band, flat_density)) continue;
      const double most = kAlike * chance(band, likeness.count);
      if (middle > most * own) return false;
      if (own > most * middle) ++louder;
    }
    if (louder > kMostLouderBands) return false;
  }
  return true;
}

double AxisBands::mean_density(const Bands& bands, std::size_t first, std::size_t end) const noexcept {
  double sum = 0.0;
  for (std::size_t band = first; band < end; ++band) sum += bins(band) * bands[band];
  return end <= first ? 0.0 : sum / static_cast<double>(edges_[end] - edges_[first]);
}

double AxisBands::chance(std::size_t band, double spectra) const noexcept {
  return portable_exp(kChance / std::sqrt(bins(band) * spectra));
}

}  // namespace gyrod::core
