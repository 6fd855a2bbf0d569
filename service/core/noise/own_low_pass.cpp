#include "core/noise/own_low_pass.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {
namespace {

/// Nearly all of wider noise is found at rest by the rules as they are.
constexpr double kNarrowAtRest = 0.5;
/// Wider than so many times that is not the same noise.
constexpr double kNearlyNarrow = 1.15;
constexpr std::size_t kFewestFlatBands = 3;
constexpr std::size_t kKept = 4;

}  // namespace

OwnLowPass::OwnLowPass(double sample_rate_hz) {
  for (auto& samples : segment_) samples.resize(kNoiseSegment);
  retime(sample_rate_hz);
}

void OwnLowPass::retime(double sample_rate_hz) noexcept {
  assert(sample_rate_hz > 0.0);
  enough_ = segments_of_half(sample_rate_hz);
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
    bands_.add(power, this_half_.axes[axis]);
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
  AxisBands::Axes sums = this_half_.axes;
  for (std::size_t axis = 0; axis < sums.size(); ++axis) {
    for (std::size_t band = 0; band < bands_.size(); ++band) sums[axis][band] += last_half_.axes[axis][band];
  }
  const AxisBands::Likeness likeness = bands_.compare(sums, this_half_.count + last_half_.count);
  Shape shape;
  if (likeness.alive >= 2) shape.independent = bands_.bandwidth(likeness, 0.0);
  if (shape.independent <= kNarrowAtRest) {
    const std::size_t flat = bands_.flat_end(likeness);
    const double density = bands_.mean_density(likeness.middle, 0, flat);
    if (flat >= kFewestFlatBands && bands_.falls(likeness, flat) && bands_.alike(likeness, density)) {
      shape.slow = density / bands_.mean_density(likeness.middle, 0, bands_.size());
      shape_ = shape;
      unlike_ = 0;
      return;
    }
  }
  if (++unlike_ > kKept || shape.independent > kNarrowAtRest * kNearlyNarrow) shape_ = {};
}

}  // namespace gyrod::core
