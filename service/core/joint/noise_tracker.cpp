#include "core/joint/noise_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/joint/sorted_bands.hpp"
#include "core/signal/moments.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Windows' lengths that are remembered.
constexpr double kMemory = 3.0;
/// Most that a band counts for, in parts of the least that it has shown: the least of many estimates is 0.8 to 0.9 of their mean.
/// Source: docs/decisions/0007, "Quiet moments".
constexpr double kRise = 1.15;
/// What is seen in the first window counts from this part of it on, and for more by this times what is missing of it over what there is.
constexpr double kFirst = 0.3;
constexpr double kFirstMargin = 0.3;
/// What the least grows by in the design's window, 8.5 s: noise that has become twice as strong is believed within six minutes, and where it was measured at
/// rest, within minutes that it is a quarter stronger.
constexpr double kForgetting = 0.03;
constexpr double kForgettingMeasured = 0.01;
/// A band this far above noise of a believed colour holds motion. A level that is 20 % too low (1.56 in power), with a colour that is off by a
/// quarter, stays below it. Source: docs/joint.md, "When the noise is not as believed".
constexpr double kMotion = 2.0;
/// What a believed spectrum is off by anyway, as one stretch at rest is not like the next: the quietest three are no louder than believed up to this.
/// Source: docs/decisions/0007, "What a model at rest is off by".
constexpr double kModelError = 1.04;
constexpr std::size_t kQuietest = 3;
/// What bands that are alike (kAlikeBands) have shown holds for as long as they are within this, as bands of noise stay: those of a road were alike by chance.
constexpr double kStillAlike = 1.6;
/// Roads are alike in so many bands for a moment, and then shake more; noise stays. So it must have lasted for so many windows' lengths for each unit
/// of ln(level), up to this level, while these bands are no further than this above the least of late; or nearly all bands agree. What speaks for it is
/// remembered up to here, and lost at this rate. Source: docs/decisions/0007, "A car that shakes is not a louder sensor".
constexpr double kLasting = 0.5;
constexpr double kMostTimed = 7.4;
constexpr double kSteady = 1.5;
constexpr std::size_t kManyAlone = 6;
constexpr double kMostEvidence = 4.0;
constexpr double kEvidenceLost = 0.5;
/// Noise of a window of n samples is off the mean of windows by a variance of this over n, motion by more: four bands that are off by this many times
/// as much hold motion. Nor is noise louder than this many times the least that quiet_level() has been, from this part of the first window on, where it
/// counts for more by this times 1 / sqrt(part) - 1. Source: docs/decisions/0007, "What changes is not noise".
constexpr double kUnrest = 25.0;
constexpr double kMostUnrest = 3.0;
constexpr double kAboveQuietest = 1.25;
constexpr double kFirstQuietest = 0.12;
constexpr double kQuietestMargin = 0.3;
/// Where the quietest four bands are below this, the level is believed to be as low.
constexpr double kFarBelow = 0.5;
/// A level is also believed by so many bands that are noise alone of a likely shape.
constexpr std::size_t kFewestAlone = 5;
/// Where a colour is believed, and noise alone would have to be tilted against it by more than this, a road is.
constexpr double kMostTilt = 0.6;
/// Between this and kMotion noise of a known colour is told from a road by more bands that are alike: 5 of 8, the quietest left out where it is apart.
/// Source: docs/decisions/0007, "A level that is a third too low".
constexpr double kLouder = 1.4;
constexpr std::size_t kManyBands = 5;
constexpr double kManyAlike = 1.3;
/// Below the believed level all that the bands show is believed, as motion only adds; so far, in case a sensor was asleep.
constexpr double kLowestLevel = 1e-3;
/// Noise that a low-pass hides: of the upper bands each has at most so much of the one before, until there is kGone of the first, where what is left
/// of a spectrum may be leakage, and the last has less than kFallen. Source: docs/joint.md, "What is reported".
constexpr std::size_t kUpperBands = 4;
constexpr double kFalls = 0.75;
constexpr double kFallen = 0.2;
constexpr double kGone = 0.05;
/// A band with more than so much of the one before is a hump, of an engine or a road.
constexpr double kRises = 1.15;
/// Beyond these the noise is said to be wrong: the spread of level() on the right noise is 0.9 to 1.3.
constexpr double kTooQuiet = 0.8;
constexpr double kTooLoud = 1.4;

/// Level of noise whose colour is known.
double level_of(std::span<const double> sorted) noexcept {
  const auto motion = std::ranges::find_if(sorted, [](double ratio) { return ratio > kMotion; });
  const std::span<const double> quiet{sorted.begin(), motion};
  if (quiet.empty()) return 1.0;
  const double all = mean(quiet);
  if (all <= 1.0) return std::max(all, kLowestLevel);
  if (2 * quiet.size() <= sorted.size()) return 1.0;
  // To the powers of 1.5 and 3, and the smaller: the loudest bands are left out as motion, and a level too low costs several times what one too
  // high costs; but vibration, unlike noise, leaves some bands as they were.
  const double quietest = mean(quiet.first(std::min(kQuietest, quiet.size()))) / kModelError;
  return std::max(1.0, std::min(all * std::sqrt(all), quietest * quietest * quietest));
}

/// The same, where bands were as quiet as `bounded` within memory: that takes from a level above 1, and does not make one below it.
double level_of(const SortedBands& ratio, const SortedBands& bounded) noexcept {
  const double level = level_of(ratio.all());
  return level <= 1.0 ? level : std::clamp(level_of(bounded.all()), 1.0, level);
}

std::span<const double> bins_of(std::span<const double> spectrum, std::size_t band) noexcept {
  const std::size_t bins = spectrum.size() - 1;
  const std::size_t begin = band * bins / kNoiseBands + 1;
  return spectrum.subspan(begin, (band + 1) * bins / kNoiseBands + 1 - begin);
}

}  // namespace

NoiseBelief belief_in(const NoiseModel& noise) noexcept {
  if (!is_usable(noise)) return NoiseBelief::kNothing;
  return noise.colour_order == 0 && noise.line_count == 0 ? NoiseBelief::kLevel : NoiseBelief::kColour;
}

void NoiseTracker::restate(std::span<const double> noise, const NoiseModel& believed) noexcept {
  const double unit = belief_in(believed) == NoiseBelief::kNothing ? 1.0 : noise_variance(believed);
  for (std::size_t band = 0; band < kNoiseBands; ++band) {
    const double power = unit * mean(bins_of(noise, band));
    const double factor = weight_ > 0.0 && power > 0.0 ? believed_power_[band] / power : 1.0;
    ratio_[band] *= factor;
    own_ratio_[band] *= factor;
    own_least_[band] *= factor;
    least_[band] *= factor;
    believed_power_[band] = power;
  }
  believed_ = believed;
  far_level_ = 0.0;
  evidence_ = 0.0;
  quietest_ = 0.0;
}

void NoiseTracker::observe(std::span<const double> periodogram, std::span<const double> noise,
                           const NoiseModel& believed, double share, double forgetting, const BandPower& own,
                           double length) noexcept {
  assert(periodogram.size() == noise.size() && periodogram.size() > kNoiseBands);
  if (believed != believed_ || weight_ == 0.0) restate(noise, believed);
  if (!std::ranges::all_of(ratio_, [](double ratio) { return std::isfinite(ratio); })) {
    *this = {};
    restate(noise, believed);
  }
  weight_ = std::min(weight_ + share, kMemory);
  const double gain = std::min(share / weight_, 1.0);
  const NoiseBelief belief = belief_in(believed_);
  const double growth =
      1.0 + forgetting * (belief == NoiseBelief::kColour ? kForgettingMeasured : kForgetting);
  const double margin = 1.0 + kFirstMargin * std::max(0.0, 1.0 - weight_) / weight_;
  const double part = std::min({weight_, length, 1.0});
  const double noise_unrest = kUnrest / (2.0 * static_cast<double>(periodogram.size() - 1) * part);
  BandPower bounded{};
  for (std::size_t band = 0; band < kNoiseBands; ++band) {
    const auto seen = bins_of(periodogram, band);
    const auto expected = bins_of(noise, band);
    const double sum =
        std::transform_reduce(seen.begin(), seen.end(), expected.begin(), 0.0, std::plus{}, std::divides{});
    const double now = sum / static_cast<double>(seen.size());
    own_ratio_[band] += gain * (now * own[band] - own_ratio_[band]);
    ratio_[band] += gain * (now - ratio_[band]);
    const double off = ratio_[band] > 0.0 ? now / ratio_[band] - 1.0 : 0.0;
    unrest_[band] += std::min(share / part, 1.0) * (off * off / noise_unrest - unrest_[band]);
    const auto least = [&](double before, double ratio) {
      return weight_ <= kFirst ? ratio * margin : std::min(growth * before, ratio * margin);
    };
    least_[band] = least(least_[band], ratio_[band]);
    own_least_[band] = least(own_least_[band], own_ratio_[band]);
    bounded[band] = belief == NoiseBelief::kNothing ? std::min(own_ratio_[band], kRise * own_least_[band])
                                                    : std::min(ratio_[band], kRise * least_[band]);
  }
  watch_quietest(growth);
  find_far_level(bounded, share);
  risen_level_ = belief != NoiseBelief::kNothing && weight_ >= 1.0 ? level_alike(ratio_) : 0.0;
  if (belief == NoiseBelief::kColour) {
    shape_ = {.level = far_level_ > 0.0 ? far_level_ : near_level(bounded)};
  } else if (far_level_ == 0.0) {
    shape_ = likely_shape(bounded, belief == NoiseBelief::kLevel);
  }
  if (belief == NoiseBelief::kLevel) bound_by_own();
}

/// Of what raises the level, only what the axis shares with no other is noise.
void NoiseTracker::bound_by_own() noexcept {
  if (shape_.level <= 1.0) return;
  const double all = quiet_level(SortedBands(ratio_, believed_power_).all());
  const double own = quiet_level(SortedBands(own_ratio_, believed_power_).all());
  if (own < all) shape_.level = std::max(1.0, shape_.level * own / all);
}

/// Where all bands are further above what is believed than noise is, and alike but for the quietest and the loudest, which may hold a line and
/// motion: the mean of those; else 0.
double NoiseTracker::level_alike(const BandPower& power) const noexcept {
  const SortedBands sorted(power, believed_power_);
  const auto all = sorted.all();
  const bool all_alike =
      all.size() >= kAlikeBands && all.front() > kMotion && all[all.size() - 2] <= kAlike * all[1];
  return all_alike ? mean(all.subspan(1, all.size() - 2)) : 0.0;
}

/// Of noise that is nearly as strong as believed: what the bands show, and no more than that where they change by more than noise does.
double NoiseTracker::near_level(const BandPower& bounded) const noexcept {
  const double level = level_of(SortedBands(ratio_, believed_power_), SortedBands(bounded, believed_power_));
  return level <= 1.0 || changes_like_noise() ? level : 1.0;
}

void NoiseTracker::watch_quietest(double growth) noexcept {
  if (weight_ < kFirstQuietest) return;
  const double margin = 1.0 + kQuietestMargin * std::max(0.0, 1.0 / std::sqrt(weight_) - 1.0);
  const double most = margin * quiet_level(SortedBands(ratio_, believed_power_).all());
  quietest_ = quietest_ > 0.0 ? std::min(growth * quietest_, most) : most;
}

/// Whether the quietest bands change from window to window no more than noise does.
bool NoiseTracker::changes_like_noise() const noexcept {
  const double telling = least_telling(believed_power_);
  const SortedBands sorted(ratio_, believed_power_);
  const auto quiet = sorted.all().first(std::min(kAlikeBands, sorted.all().size()));
  if (quiet.empty()) return false;
  double unrest = 0.0;
  double bands = 0.0;
  for (std::size_t band = 0; band < kNoiseBands; ++band) {
    if (believed_power_[band] < telling || ratio_[band] > quiet.back()) continue;
    unrest += unrest_[band];
    bands += 1.0;
  }
  return unrest <= kMostUnrest * bands;
}

/// Whether a level above the believed one has been found for long enough, or by nearly all bands.
/// @param found whether it is found now
/// @param by_nearly_all whether nearly all bands show it
/// @param quietest what the quietest bands have shown of late
bool NoiseTracker::has_lasted(bool found, bool by_nearly_all, double level, double quietest,
                              double share) noexcept {
  const double now = quietest_of(SortedBands(ratio_, believed_power_).all());
  const bool steady = changes_like_noise() && (now <= kSteady * quietest || level_alike(ratio_) > 0.0);
  const double needed = kLasting * portable_log(std::clamp(level, 1.0, kMostTimed));
  evidence_ = found && steady ? std::min(evidence_ + share, kMostEvidence)
                              : std::max(evidence_ - kEvidenceLost * share, 0.0);
  if (found && steady && by_nearly_all) evidence_ = std::max(evidence_, needed);
  return evidence_ >= needed;
}

/// A believed level that is wrong by a factor, as of another sensor or in another unit. Too low: no band is as quiet as that, for as long as none is.
/// Too high: motion only adds.
void NoiseTracker::find_far_level(const BandPower& power, double share) noexcept {
  const SortedBands ordered(power, believed_power_);
  const auto sorted = ordered.all();
  const bool few = sorted.size() <= kAlikeBands;
  const auto four = alike(sorted, kAlikeBands, kAlike);
  const double quiet = quiet_level(sorted);
  const bool below = quiet < kFarBelow;
  const bool many_alike = sorted.size() > kManyBands && !alike(sorted, kManyBands, kManyAlike).empty();
  const bool louder = belief_in(believed_) == NoiseBelief::kColour && sorted.front() > kLouder &&
                      (far_level_ > 0.0 || many_alike);
  const bool above = !few && (sorted.front() > kMotion || louder);
  if (belief_in(believed_) == NoiseBelief::kNothing || weight_ < 1.0 || (!below && !above)) {
    far_level_ = 0.0;
    evidence_ = 0.0;
    return;
  }
  NoiseShape likely = likely_shape(power, false);
  likely.level = std::max(likely.level, kLowestLevel);
  const bool whole = belief_in(believed_) == NoiseBelief::kLevel;
  const std::size_t alone = bands_of_noise_alone(power, likely);
  const double level = whole ? likely.level : std::max(quiet, kLowestLevel);
  const bool possible = whole || level <= kAboveQuietest * quietest_;
  const bool shown = below || !four.empty() || ((whole || likely.tilt < kMostTilt) && alone >= kFewestAlone);
  const bool found = possible && shown;
  const bool holds = whole || (possible && !alike(sorted, kAlikeBands, kStillAlike).empty());
  const double far = found ? level : (holds ? std::min(far_level_, level) : 0.0);
  const bool by_nearly_all = level_alike(power) > 0.0 || (whole && alone >= kManyAlone);
  far_level_ = below || has_lasted(found, by_nearly_all, far, quietest_of(sorted), share) ? far : 0.0;
  if (whole && far_level_ > 0.0) shape_ = likely;
}

bool NoiseTracker::is_hidden() const noexcept {
  if (belief_in(believed_) != NoiseBelief::kNothing || weight_ < 1.0) return false;
  const auto rises = [](double before, double after) { return after > kRises * before; };
  if (std::ranges::adjacent_find(ratio_, rises) != ratio_.end()) return false;
  const std::span<const double> upper = std::span(ratio_).last(kUpperBands);
  for (std::size_t band = 1; band < upper.size(); ++band) {
    if (upper[band] < kGone * upper.front()) return true;
    if (upper[band] > kFalls * upper[band - 1]) return false;
  }
  return upper.back() < kFallen * upper.front();
}

bool NoiseTracker::disagrees() const noexcept {
  return belief_in(believed_) != NoiseBelief::kNothing && (level() < kTooQuiet || shown_level() > kTooLoud);
}

}  // namespace gyrod::core
