#include "core/noise/standstill_learner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/noise/noise_lines.hpp"
#include "core/noise/same_noise.hpp"

namespace gyrod::core {
namespace {

constexpr double kLeastSegments = 5.0;
constexpr double kFewestSeconds = 10.0;

/// Moves a mean of `weight` towards a value of weight `added`.
void blend(Triple& mean, double weight, const Triple& value, double added) noexcept {
  for (std::size_t axis = 0; axis < mean.size(); ++axis) {
    mean[axis] += (value[axis] - mean[axis]) * added / (weight + added);
  }
}

bool is_dead(const NoiseModel& model) noexcept { return model == NoiseModel{}; }

bool is_good(const StandstillState& state) noexcept {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto good = [](const NoiseModel& model) { return is_usable(model) || is_dead(model); };
  return positive(state.sample_rate_hz) && positive(state.rest_seconds) && positive(state.segments) &&
         positive(state.bias_seconds) && std::ranges::all_of(state.bias, finite) &&
         std::ranges::all_of(state.models, good) && !std::ranges::all_of(state.models, is_dead);
}

}  // namespace

StandstillLearner::StandstillLearner(double sample_rate_hz) : detector_(sample_rate_hz) {
  retime(sample_rate_hz);
}

void StandstillLearner::retime(double sample_rate_hz) noexcept {
  detector_.retime(sample_rate_hz);
  segment_seconds_ = 0.5 * static_cast<double>(kNoiseSegment) / sample_rate_hz;
  least_segments_ = std::max(kLeastSegments, kFewestSeconds / segment_seconds_);
  most_segments_ = std::max(2.0 * kLeastSegments, kNoiseMemorySeconds / segment_seconds_);
  at_rest_ = false;
  forget();
  state_ = {};
  state_.sample_rate_hz = sample_rate_hz;
  has_bias_ = {};
  other_seconds_ = 0.0;
}

bool StandstillLearner::step(const Triple& rate, const Triple* accelerometer, bool measured) noexcept {
  const bool ended = measured ? detector_.step(rate, accelerometer) : detector_.bridge(rate, accelerometer);
  if (detector_.verdict() == RestVerdict::kTooEarly) at_rest_ = false;
  if (ended) end_block();
  return ended;
}

void StandstillLearner::interrupt() noexcept {
  detector_.interrupt();
  at_rest_ = false;
}

void StandstillLearner::end_block() noexcept {
  block_seconds_ = static_cast<double>(detector_.block_samples()) / state_.sample_rate_hz;
  at_rest_ = detector_.verdict() == RestVerdict::kRest && believes();
  if (at_rest_) learn();
}

bool StandstillLearner::believes() noexcept { return believes_level() && believes_bias(); }

bool StandstillLearner::believes_level() noexcept {
  const Triple& now = detector_.variance();
  bool louder = false;
  bool quieter = false;
  for (std::size_t axis = 0; axis < now.size(); ++axis) {
    if (!(level_[axis] > 0.0)) continue;
    if (now[axis] == 0.0)
      return false;  // stuck: nothing can be told of the axis, nor is it what the state is to forget
    louder = louder || now[axis] > kSameLevel * level_[axis];
    quieter = quieter || now[axis] * kSameLevel < level_[axis];
  }
  louder_seconds_ = louder ? louder_seconds_ + block_seconds_ : 0.0;
  if (quieter || louder_seconds_ > kOutvotedLevelSeconds) {
    forget();
    return true;
  }
  return !louder;
}

bool StandstillLearner::believes_bias() noexcept {
  if (state_.bias_seconds == 0.0) return true;
  if (same_bias(state_.bias)) {
    other_seconds_ = std::max(other_seconds_ - block_seconds_, 0.0);
    return true;
  }
  vote_for_other_bias();
  if (other_seconds_ <= state_.bias_seconds) return false;
  state_.bias = other_bias_;
  state_.bias_seconds = other_seconds_;
  other_seconds_ = 0.0;
  return true;
}

/// Of the axes that have one.
bool StandstillLearner::same_bias(const Triple& bias) const noexcept {
  for (std::size_t axis = 0; axis < bias.size(); ++axis) {
    if (has_bias_[axis] && std::abs(detector_.mean()[axis] - bias[axis]) > kSameBias) return false;
  }
  return true;
}

void StandstillLearner::vote_for_other_bias() noexcept {
  if (other_seconds_ > 0.0 && !same_bias(other_bias_)) {
    other_seconds_ = std::max(other_seconds_ - block_seconds_, 0.0);
    return;
  }
  blend(other_bias_, other_seconds_, detector_.mean(), block_seconds_);
  other_seconds_ += block_seconds_;
}

void StandstillLearner::learn() noexcept {
  learn_bias();
  const AxisSums& fresh = detector_.fresh();
  if (fresh.count == 0.0) return;
  // An axis that does not change has no spectrum but that of rounding.
  std::array<bool, 3> alive{};
  for (std::size_t axis = 0; axis < alive.size(); ++axis) alive[axis] = detector_.variance()[axis] > 0.0;
  spectra_.blend(fresh, alive, most_segments_);
  for (std::size_t axis = 0; axis < alive.size(); ++axis) {
    if (!alive[axis]) continue;
    since_fit_[axis] += fresh.count;
    const auto& power = spectra_.power[axis];
    level_[axis] = std::accumulate(power.begin(), power.end(), 0.0) / static_cast<double>(kNoiseBins);
  }
  state_.segments = std::ranges::max(spectra_.segments);
  state_.rest_seconds += fresh.count * segment_seconds_;
  fit();
}

void StandstillLearner::learn_bias() noexcept {
  const double weight = std::min(state_.bias_seconds, kNoiseMemorySeconds - block_seconds_);
  for (std::size_t axis = 0; axis < has_bias_.size(); ++axis) {
    if (has_bias_[axis] || !(detector_.variance()[axis] > 0.0)) continue;
    state_.bias[axis] = detector_.mean()[axis];
    has_bias_[axis] = true;
  }
  blend(state_.bias, weight, detector_.mean(), block_seconds_);
  state_.bias_seconds = weight + block_seconds_;
}

void StandstillLearner::fit() noexcept {
  bool fitted = false;
  for (std::size_t axis = 0; axis < since_fit_.size(); ++axis) {
    const double segments = spectra_.segments[axis];
    if (segments < least_segments_ || since_fit_[axis] < kRefit * segments) continue;
    state_.models[axis] = fit_noise_and_lines(spectra_, axis).value_or(NoiseModel{});
    since_fit_[axis] = 0.0;
    fitted = true;
  }
  if (fitted) ++revision_;
}

/// The noise; the bias has its own vote.
void StandstillLearner::forget() noexcept {
  const bool had_models = !std::ranges::all_of(state_.models, is_dead);
  state_.models = {};
  state_.segments = 0.0;
  state_.rest_seconds = 0.0;
  spectra_ = {};
  level_ = since_fit_ = {};
  louder_seconds_ = 0.0;
  if (had_models) ++revision_;
}

bool StandstillLearner::restore(const StandstillState& state) noexcept {
  const double rate = state_.sample_rate_hz;
  if (!is_good(state) || !is_same_rate(state.sample_rate_hz, rate)) return false;
  state_ = state;
  state_.sample_rate_hz = rate;
  state_.segments = std::min(state.segments, most_segments_);
  state_.bias_seconds = std::min(state.bias_seconds, kNoiseMemorySeconds);
  spectra_ = {};
  for (std::size_t axis = 0; axis < has_bias_.size(); ++axis) {
    const bool dead = is_dead(state_.models[axis]);
    auto& power = spectra_.power[axis];
    for (std::size_t k = 0; k < kNoiseBins; ++k) {
      const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(kNoiseSegment);
      power[k] = dead ? 0.0 : noise_spectrum(without_lines(state_.models[axis]), w);
    }
    add_lines(state_.models[axis], power);
    spectra_.segments[axis] = dead ? 0.0 : state_.segments;
    has_bias_[axis] = !dead;
    level_[axis] = dead ? 0.0 : noise_variance(state_.models[axis]);
  }
  since_fit_ = {};
  louder_seconds_ = other_seconds_ = 0.0;
  ++revision_;
  return true;
}

}  // namespace gyrod::core
