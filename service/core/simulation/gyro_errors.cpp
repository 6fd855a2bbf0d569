#include "core/simulation/gyro_errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

constexpr double kShortestTimeConstantS = 0.1;
constexpr double kTimeConstantRatio = 10.0;

/// exp(-period / time constant) by its (1,1) Pade approximant, made of + - * / alone; 0 for a stage faster
/// than the sampling.
double decay_of(double period_s, double time_constant_s) noexcept {
  const double half = 0.5 * period_s / time_constant_s;
  return std::max(0.0, (1.0 - half) / (1.0 + half));
}

double saturate(double rate, double range) noexcept {
  return range > 0.0 ? std::clamp(rate, -range, range) : rate;
}

double quantise(double rate, double step) noexcept {
  return step > 0.0 ? step * std::round(rate / step) : rate;
}

}  // namespace

GyroErrors::GyroErrors(const GyroErrorOptions& options, double sample_rate_hz, std::uint64_t seed) noexcept
    : options_(options),
      random_(seed),
      white_std_(options.white_noise_density * std::sqrt(sample_rate_hz)),
      walk_step_(options.rate_random_walk / std::sqrt(sample_rate_hz)) {
  assert(sample_rate_hz > 0.0);
  start_flicker(sample_rate_hz);
}

double GyroErrors::measure(double truth_radps) noexcept {
  const double noise = next_flicker() + next_random_walk() + white_std_ * random_.normal();
  return quantise(saturate(truth_radps + (options_.bias_radps + noise), options_.range_radps),
                  options_.step_radps);
}

/// Stationary: each stage starts with its own standard deviation and keeps it.
void GyroErrors::start_flicker(double sample_rate_hz) noexcept {
  const double stage_variance = portable_log(kTimeConstantRatio) * std::numbers::inv_pi;
  const double stage_std = options_.bias_instability_radps * std::sqrt(stage_variance);
  double time_constant_s = kShortestTimeConstantS;
  for (auto& stage : flicker_) {
    stage.decay = decay_of(1.0 / sample_rate_hz, time_constant_s);
    stage.drive = stage_std * std::sqrt(1.0 - stage.decay * stage.decay);
    stage.value = stage_std * random_.normal();
    time_constant_s *= kTimeConstantRatio;
  }
}

double GyroErrors::next_flicker() noexcept {
  if (options_.bias_instability_radps == 0.0) return 0.0;
  double sum = 0.0;
  for (auto& stage : flicker_) {
    sum += stage.value;
    stage.value = stage.decay * stage.value + stage.drive * random_.normal();
  }
  return sum;
}

double GyroErrors::next_random_walk() noexcept {
  const double now = walk_;
  walk_ += walk_step_ * random_.normal();
  return now;
}

}  // namespace gyrod::core
