#include "core/noise/hidden_noise_learner.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "core/noise/noise_lines.hpp"
#include "core/noise/same_noise.hpp"

namespace gyrod::core {
namespace {

/// Of a segment's samples: two in a hundred.
constexpr std::size_t kMostUnmeasured = kNoiseSegment / 50;
/// Samples that an axis may repeat: one that hangs is no quiet one.
constexpr std::size_t kMostRepeats = 64;
constexpr double kHalvesToLearn = 4.0;
/// Hands and steering are slower.
constexpr double kMotionHz = 10.0;

constexpr AxisBands::Axes nothing_seen() {
  AxisBands::Axes axes{};
  for (auto& bands : axes) bands.fill(std::numeric_limits<double>::infinity());
  return axes;
}
constexpr AxisBands::Axes kNothingSeen = nothing_seen();

}  // namespace

HiddenNoiseLearner::HiddenNoiseLearner(double sample_rate_hz)
    : periodogram_(kNoiseSegment), own_lines_(static_cast<double>(kSegmentHop) / sample_rate_hz) {
  for (auto& samples : segment_) samples.resize(kNoiseSegment);
  retime(sample_rate_hz);
}

void HiddenNoiseLearner::retime(double sample_rate_hz) noexcept {
  assert(sample_rate_hz > 0.0);
  const double segment_seconds = static_cast<double>(kSegmentHop) / sample_rate_hz;
  half_segments_ = segments_of_half(sample_rate_hz);
  half_seconds_ = half_segments_ * segment_seconds;
  motion_bins_ = kMotionHz * static_cast<double>(kNoiseSegment) / sample_rate_hz;
  least_segments_ = kHalvesToLearn * half_segments_;
  most_segments_ = std::max(least_segments_, kNoiseMemorySeconds / segment_seconds);
  least_ = least_before_ = kNothingSeen;
  least_seconds_ = 0.0;
  own_lines_.retime(segment_seconds);
  forget();
  interrupt();
}

void HiddenNoiseLearner::interrupt() noexcept {
  in_segment_ = 0;
  unmeasured_ = {};
  repeats_ = {};
  this_half_ = last_half_ = {};
  last_counted_ = false;
  own_lines_.interrupt();
}

void HiddenNoiseLearner::step(const Triple& rate, bool measured) noexcept {
  for (std::size_t axis = 0; axis < rate.size(); ++axis) {
    segment_[axis][in_segment_] = rate[axis];
    repeats_[axis] = rate[axis] == last_[axis] ? repeats_[axis] + 1 : 0;
    measured = measured && repeats_[axis] <= kMostRepeats;
  }
  last_ = rate;
  if (!measured) ++unmeasured_[in_segment_ / kSegmentHop];
  if (++in_segment_ == kNoiseSegment) end_segment();
}

void HiddenNoiseLearner::end_segment() noexcept {
  if (unmeasured_[0] + unmeasured_[1] <= kMostUnmeasured)
    add_segment();
  else
    own_lines_.interrupt();
  for (auto& samples : segment_) std::copy(samples.begin() + kSegmentHop, samples.end(), samples.begin());
  in_segment_ = kSegmentHop;
  unmeasured_ = {unmeasured_[1], 0};
  if (this_half_.bands.count >= half_segments_) end_half();
}

void HiddenNoiseLearner::add_segment() noexcept {
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    NoiseSpectrum power;
    periodogram_.transform(segment_[axis], power);
    std::ranges::copy(periodogram_.spectrum(), transforms_[axis].begin());
  }
  AxisSums sums;
  sums.add(transforms_);
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    const NoiseSpectrum& power = sums.power[axis];
    NoiseSpectrum in_phase;
    for (std::size_t k = 0; k < kNoiseBins; ++k) in_phase[k] = sums.cross[axis][k].real();
    bands_.add(power, this_half_.bands.own[axis]);
    bands_.add(in_phase, this_half_.bands.shared[axis]);
    for (std::size_t k = 0; k < kNoiseBins; ++k) this_half_.power[axis][k] += power[k];
  }
  this_half_.bands.count += 1.0;
  if (own_lines_.add(transforms_, sums)) publish();
}

void HiddenNoiseLearner::end_half() noexcept {
  bool learned = false;
  if (last_half_.bands.count > 0.0) {
    watch_least();
    const auto found = find_noise_alone(bands_, last_half_.bands, this_half_.bands, least(), motion_bins_);
    learned = found && believes(*found);
    if (learned) {
      if (!last_counted_) learn(last_half_, found->first);
      learn(this_half_, found->first);
      fit();
    }
  }
  last_counted_ = learned;
  last_half_ = this_half_;
  this_half_ = {};
}

/// Of ten to twenty minutes.
void HiddenNoiseLearner::watch_least() noexcept {
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t band = 0; band < bands_.size(); ++band) {
      const double density = (last_half_.bands.own[axis][band] + this_half_.bands.own[axis][band]) /
                             (last_half_.bands.count + this_half_.bands.count);
      least_[axis][band] = std::min(least_[axis][band], density);
    }
  }
  least_seconds_ += half_seconds_;
  if (least_seconds_ < kNoiseMemorySeconds) return;
  least_before_ = std::exchange(least_, kNothingSeen);
  least_seconds_ = 0.0;
}

AxisBands::Axes HiddenNoiseLearner::least() const noexcept {
  AxisBands::Axes result = least_;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t band = 0; band < bands_.size(); ++band)
      result[axis][band] = std::min(result[axis][band], least_before_[axis][band]);
  }
  return result;
}

/// Densities of what has been learned.
AxisBands::Axes HiddenNoiseLearner::held() const noexcept {
  AxisBands::Axes result{};
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) bands_.add(power_[axis], result[axis]);
  return result;
}

/// Whether it is as loud as what has been learned, on all axes, where both tell.
bool HiddenNoiseLearner::believes(const NoiseAlone& found) noexcept {
  bool louder = false;
  bool quieter = false;
  const AxisBands::Axes learned = held();
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    double before = 0.0;
    double now = 0.0;
    for (std::size_t band = found.first; band < bands_.size(); ++band) {
      if (weight_[band] == 0.0 || !found.tells(band)) continue;
      before += bands_.bins(band) * learned[axis][band];
      now += bands_.bins(band) * found.density[axis][band];
    }
    louder = louder || now > kSameLevel * before;
    quieter = quieter || now * kSameLevel < before;
  }
  louder_seconds_ = louder && !quieter ? louder_seconds_ + half_seconds_ : 0.0;
  if (!quieter && !louder) return true;
  // Of two spectra that do not agree, and little besides, the later one is as good as the other.
  if (!quieter && has_enough() && louder_seconds_ < kOutvotedLevelSeconds) return false;
  forget();
  return true;
}

void HiddenNoiseLearner::learn(const Half& half, std::size_t first) noexcept {
  for (std::size_t band = first; band < bands_.size(); ++band) {
    const double kept = std::min(weight_[band], most_segments_ - half.bands.count);
    weight_[band] = kept + half.bands.count;
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      for (std::size_t k = bands_.edge(band); k < bands_.edge(band + 1); ++k)
        power_[axis][k] = (kept * power_[axis][k] + half.power[axis][k]) / weight_[band];
    }
  }
  since_fit_ += half.bands.count;
}

void HiddenNoiseLearner::fit() noexcept {
  const double weight = weight_[bands_.size() - 1];
  if (!has_enough() || since_fit_ < kRefit * weight) return;
  const auto first = static_cast<std::size_t>(
      std::ranges::find_if(weight_, [this](double segments) { return segments >= least_segments_; }) -
      weight_.begin());
  const Triple scale = scales(first);
  const NoiseSpectrum shape = quietest_shape(first, scale);
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    NoiseSpectrum noise = shape;
    for (double& density : noise) density *= scale[axis];
    fitted_[axis] = fit_noise_and_lines(noise, weight).value_or(NoiseModel{});
  }
  since_fit_ = 0.0;
  publish();
}

void HiddenNoiseLearner::publish() noexcept {
  const auto before = models_;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    const NoiseModel& own = own_lines_.lines()[axis];
    models_[axis] = fitted_[axis];
    if (fitted_[axis].line_count > 0) continue;
    models_[axis].line_count = own.line_count;
    models_[axis].line = own.line;
  }
  if (models_ != before) ++revision_;
}

/// Density of each axis in parts of the middle one: where the low-pass falls off, as motion is slower than that.
Triple HiddenNoiseLearner::scales(std::size_t first) const noexcept {
  const AxisBands::Axes learned = held();
  const AxisBands::Likeness likeness = bands_.compare(learned, weight_[bands_.size() - 1], first);
  const std::size_t flat_end = std::max(bands_.flat_end(likeness), first + 1);
  const double density = bands_.mean_density(likeness.middle, first, flat_end);
  Triple result{};
  double bins = 0.0;
  for (std::size_t band = flat_end; band < bands_.size(); ++band) {
    if (band > flat_end && !AxisBands::tells(likeness, band, density)) continue;
    bins += bands_.bins(band);
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis)
      result[axis] += bands_.bins(band) * learned[axis][band] / likeness.middle[band];
  }
  for (double& scale : result) scale /= bins;
  return result;
}

/// Band by band the mean of the quietest of the axes and of those that are louder by chance, as motion only adds; before the first of them as dense as
/// those after it that are alike.
NoiseSpectrum HiddenNoiseLearner::quietest_shape(std::size_t first, const Triple& scale) const noexcept {
  const double weight = weight_[bands_.size() - 1];
  const AxisBands::Axes learned = held();
  NoiseSpectrum shape{};
  for (std::size_t band = first; band < bands_.size(); ++band) {
    Triple density{};
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) density[axis] = learned[axis][band] / scale[axis];
    const double most = bands_.chance(band, weight) * std::ranges::min(density);
    const auto quiet =
        static_cast<double>(std::ranges::count_if(density, [most](double value) { return value <= most; }));
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      if (density[axis] > most) continue;
      for (std::size_t k = bands_.edge(band); k < bands_.edge(band + 1); ++k)
        shape[k] += power_[axis][k] / (scale[axis] * quiet);
    }
  }
  AxisBands::Bands bands{};
  bands_.add(shape, bands);
  const AxisBands::Likeness likeness = bands_.compare({bands, bands, bands}, weight, first);
  const std::size_t flat_end = std::max(bands_.flat_end(likeness), first + 1);
  std::fill_n(shape.begin(), bands_.edge(first), bands_.mean_density(bands, first, flat_end));
  return shape;
}

void HiddenNoiseLearner::forget() noexcept {
  fitted_ = {};
  publish();
  power_ = {};
  weight_ = {};
  since_fit_ = louder_seconds_ = 0.0;
  last_counted_ = false;
}

}  // namespace gyrod::core
