#include "core/noise/own_low_pass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/noise/spectrum_floor.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kSegmentHop = kNoiseSegment / 2;
/// Bands end a quarter above where they begin, two bins at least.
constexpr std::size_t kBandWidth = 4;
constexpr std::size_t kFewestBins = 2;
/// What is left of the spectrum after the last band, up to so many bins, is part of it.
constexpr std::size_t kFewestLastBins = 10;
constexpr double kSegmentsOfHalf = 4.0;
constexpr double kSecondsOfHalf = 4.0;
/// Nearly all of wider noise is found at rest by the rules as they are.
constexpr double kNarrow = 0.5;
/// Of the flat part: less than this in a band that chance does not explain ends it.
constexpr double kEndOfFlat = 0.75;
constexpr std::size_t kFewestFlatBands = 3;
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
constexpr std::size_t kKept = 4;

}  // namespace

OwnLowPass::OwnLowPass(double sample_rate_hz) {
  for (auto& samples : segment_) samples.resize(kNoiseSegment);
  edges_[0] = kFirstNoiseBin;
  while (edges_[bands_] < kNoiseBins) {
    const std::size_t first = edges_[bands_];
    const std::size_t end = first + std::max(kFewestBins, first / kBandWidth);
    edges_[++bands_] = end + kFewestLastBins > kNoiseBins ? kNoiseBins : end;
    assert(bands_ <= kMostBands);
  }
  retime(sample_rate_hz);
}

void OwnLowPass::retime(double sample_rate_hz) noexcept {
  assert(sample_rate_hz > 0.0);
  enough_ = std::max(kSegmentsOfHalf,
                     std::ceil(kSecondsOfHalf * sample_rate_hz / static_cast<double>(kSegmentHop)));
  interrupt();
}

void OwnLowPass::interrupt() noexcept {
  in_segment_ = unlike_ = 0;
  this_half_ = last_half_ = {};
  shape_ = {};
}

void OwnLowPass::step(const std::array<double, 3>& sample, Periodogram& periodogram) noexcept {
  for (std::size_t axis = 0; axis < sample.size(); ++axis) segment_[axis][in_segment_] = sample[axis];
  if (++in_segment_ == kNoiseSegment) end_segment(periodogram);
}

void OwnLowPass::end_segment(Periodogram& periodogram) noexcept {
  NoiseSpectrum power;
  for (std::size_t axis = 0; axis < segment_.size(); ++axis) {
    periodogram.transform(segment_[axis], power);
    for (std::size_t band = 0; band < bands_; ++band) {
      double sum = 0.0;
      for (std::size_t k = edges_[band]; k < edges_[band + 1]; ++k) sum += power[k];
      this_half_.axes[axis][band] += sum / bins(band);
    }
    std::copy(segment_[axis].begin() + kSegmentHop, segment_[axis].end(), segment_[axis].begin());
  }
  in_segment_ = kSegmentHop;
  this_half_.count += 1.0;
  if (last_half_.count > 0.0) judge();
  if (this_half_.count < enough_) return;
  last_half_ = this_half_;
  this_half_ = {};
}

void OwnLowPass::judge() noexcept {
  const Likeness likeness = compare();
  Shape shape = likeness.alive < 2 ? Shape{} : shape_of(likeness.middle);
  if (shape.independent <= kNarrow) {
    const std::size_t flat = flat_bands(likeness);
    const double density = mean_density(likeness.middle, flat);
    if (flat >= kFewestFlatBands && falls(likeness, flat) && alike(likeness, density)) {
      shape.slow = density / mean_density(likeness.middle, bands_);
      shape_ = shape;
      unlike_ = 0;
      return;
    }
  }
  if (++unlike_ > kKept || shape.independent > kNarrow * kRises) shape_ = {};
}

OwnLowPass::Likeness OwnLowPass::compare() const noexcept {
  Likeness result;
  result.count = this_half_.count + last_half_.count;
  for (std::size_t axis = 0; axis < segment_.size(); ++axis) {
    Bands& bands = result.axes[result.alive];
    for (std::size_t band = 0; band < bands_; ++band)
      bands[band] = this_half_.axes[axis][band] + last_half_.axes[axis][band];
    const double mean = mean_density(bands, bands_);
    if (!(mean > 0.0) || !std::isfinite(mean)) continue;
    for (double& density : bands) density /= mean;
    ++result.alive;
  }
  if (result.alive < 2) return result;
  result.spectra = kMedian * result.count * static_cast<double>(result.alive);
  find_middle(result);
  for (std::size_t axis = 0; axis < result.alive; ++axis) scale_to_middle(result.axes[axis], result.middle);
  find_middle(result);
  return result;
}

/// Band by band the middle one of three axes, the mean of two.
void OwnLowPass::find_middle(Likeness& likeness) const noexcept {
  const auto& [x, y, z] = likeness.axes;
  for (std::size_t band = 0; band < bands_; ++band) {
    likeness.middle[band] = likeness.alive < 3 ? 0.5 * (x[band] + y[band])
                                               : std::max(std::min(x[band], y[band]),
                                                          std::min(std::max(x[band], y[band]), z[band]));
  }
}

/// By the middle one of their ratios in the bands that have power.
void OwnLowPass::scale_to_middle(Bands& axis, const Bands& middle) const noexcept {
  const double loud = kFallen * *std::max_element(middle.begin(), middle.begin() + bands_);
  Bands ratios{};
  std::size_t count = 0;
  for (std::size_t band = 0; band < bands_; ++band) {
    if (middle[band] > loud) ratios[count++] = axis[band] / middle[band];
  }
  const auto centre = ratios.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(ratios.begin(), centre, ratios.begin() + static_cast<std::ptrdiff_t>(count));
  if (!(*centre > 0.0)) return;
  for (double& density : axis) density /= *centre;
}

OwnLowPass::Shape OwnLowPass::shape_of(const Bands& middle) const noexcept {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t band = 0; band < bands_; ++band) {
    sum += bins(band) * middle[band];
    squares += bins(band) * middle[band] * middle[band];
    count += bins(band);
  }
  return {.independent = std::min(sum * sum / (count * squares), 1.0)};
}

/// How many bands from the slow end on are alike; 0 where one of them rises.
std::size_t OwnLowPass::flat_bands(const Likeness& likeness) const noexcept {
  for (std::size_t flat = 1; flat < bands_; ++flat) {
    const double density = mean_density(likeness.middle, flat);
    const double chance_of = chance(flat, likeness.spectra);
    if (likeness.middle[flat] * std::sqrt(chance_of) < kEndOfFlat * density) return flat;
    if (likeness.middle[flat] > kRises * chance_of * density) return 0;
  }
  return bands_;
}

bool OwnLowPass::falls(const Likeness& likeness, std::size_t flat) const noexcept {
  for (std::size_t band = flat + 1; band < bands_; ++band) {
    if (likeness.middle[band] > kRises * chance(band, likeness.spectra) * likeness.middle[band - 1])
      return false;
  }
  return likeness.middle[bands_ - 1] < kFallen * mean_density(likeness.middle, flat);
}

bool OwnLowPass::alike(const Likeness& likeness, double flat_density) const noexcept {
  for (std::size_t axis = 0; axis < likeness.alive; ++axis) {
    std::size_t louder = 0;
    for (std::size_t band = 0; band < bands_; ++band) {
      const double own = likeness.axes[axis][band];
      const double middle = likeness.middle[band];
      if (middle < kFallen * flat_density) continue;
      const double most = kAlike * chance(band, likeness.count);
      if (middle > most * own) return false;
      if (own > most * middle) ++louder;
    }
    if (louder > kMostLouderBands) return false;
  }
  return true;
}

/// Of the first so many bands.
double OwnLowPass::mean_density(const Bands& bands, std::size_t count) const noexcept {
  double sum = 0.0;
  for (std::size_t band = 0; band < count; ++band) sum += bins(band) * bands[band];
  return count == 0 ? 0.0 : sum / static_cast<double>(edges_[count] - edges_[0]);
}

/// Ratio by which the band's mean over so many spectra may be off.
double OwnLowPass::chance(std::size_t band, double spectra) const noexcept {
  return portable_exp(kChance / std::sqrt(bins(band) * spectra));
}

}  // namespace gyrod::core
