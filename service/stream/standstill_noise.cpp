#include "stream/standstill_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/noise/noise_units.hpp"
#include "core/noise/still_noise.hpp"

namespace gyrod::stream {
namespace {

/// The learner has to be made for some rate before there is one; it takes no sample until then.
constexpr double kAnyRateHz = 100.0;
/// That of core::at_rate() and of the learner's state.
constexpr double kSameRate = 0.02;

bool same_rate(double a_hz, double b_hz) noexcept { return std::abs(a_hz - b_hz) <= kSameRate * b_hz; }

const core::NoiseModel* strongest(const std::array<core::NoiseModel, kAxes>& models) noexcept {
  const core::NoiseModel* found = nullptr;
  for (const core::NoiseModel& model : models) {
    if (!core::is_usable(model)) continue;
    if (found == nullptr || core::noise_variance(model) > core::noise_variance(*found)) found = &model;
  }
  return found;
}

/// @pre sample_rate_hz > 0
ChannelNoise calibrated_noise(const CalibratedNoise& calibrated, double sample_rate_hz) noexcept {
  std::array<core::NoiseModel, kAxes> models = calibrated.models;
  for (core::NoiseModel& model : models) {
    if (core::is_usable(model)) model = core::at_rate(model, calibrated.sample_rate_hz, sample_rate_hz);
  }
  return channel_noise(NoiseSource::kCalibrated, models);
}

/// Nothing where a value is not finite: the accelerometer has failed, or has none to give.
const core::Triple* force_of(const Sample& sample) noexcept {
  if (!sample.specific_force_mps2) return nullptr;
  const core::Triple& force = *sample.specific_force_mps2;
  return std::ranges::all_of(force, [](double value) { return std::isfinite(value); }) ? &force : nullptr;
}

double first_rate(const StandstillOptions& options) noexcept {
  if (options.sample_rate_hz > 0.0) return options.sample_rate_hz;
  if (options.remembered) return options.remembered->sample_rate_hz;
  return options.calibrated ? options.calibrated->sample_rate_hz : 0.0;
}

}  // namespace

ChannelNoise channel_noise(NoiseSource source, const std::array<core::NoiseModel, kAxes>& models) noexcept {
  const core::NoiseModel* stand_in = strongest(models);
  if (stand_in == nullptr) return {};
  ChannelNoise noise{source, {}};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const core::NoiseModel& model = core::is_usable(models[axis]) ? models[axis] : *stand_in;
    noise.axis[axis] = core::scaled(model, core::kNoiseMargin);
  }
  return noise;
}

ChannelNoise noise_beforehand(const StandstillOptions& options) noexcept {
  const double rate_hz = first_rate(options);
  if (options.calibrated) return calibrated_noise(*options.calibrated, rate_hz);
  if (!options.remembered || !options.use_learned) return {};
  if (!same_rate(options.remembered->sample_rate_hz, rate_hz)) return {};
  return channel_noise(NoiseSource::kStandstill, options.remembered->models);
}

StandstillNoise::StandstillNoise(StandstillOptions options)
    : options_(std::move(options)),
      rate_hz_(first_rate(options_)),
      learner_(rate_hz_ > 0.0 ? rate_hz_ : kAnyRateHz) {
  if (options_.remembered) learner_.restore(*options_.remembered);
  revision_ = learner_.revision();
}

void StandstillNoise::step(const Sample& sample, bool measured, double sample_rate_hz) noexcept {
  follow_rate(sample_rate_hz);
  if (!(rate_hz_ > 0.0)) return;
  if (measured) {
    learner_.step(sample.rate_radps, force_of(sample));
  } else {
    learner_.interrupt();
  }
}

void StandstillNoise::follow_rate(double sample_rate_hz) noexcept {
  if (!(sample_rate_hz > 0.0) || same_rate(sample_rate_hz, rate_hz_)) {
    agreeing_ = 0;
    return;
  }
  if (agreeing_ == 0 || !same_rate(sample_rate_hz, other_rate_hz_)) {
    other_rate_hz_ = sample_rate_hz;
    agreeing_ = 0;
  }
  if (++agreeing_ >= kAgreeing) take_rate(sample_rate_hz);
}

void StandstillNoise::take_rate(double sample_rate_hz) noexcept {
  rate_hz_ = sample_rate_hz;
  agreeing_ = 0;
  rate_changed_ = true;
  learner_.retime(sample_rate_hz);
}

std::optional<ChannelNoise> StandstillNoise::update() noexcept {
  const bool learned = learner_.revision() != revision_;
  revision_ = learner_.revision();
  if (learned && options_.on_learned) options_.on_learned(learner_.state());
  if (std::exchange(rate_changed_, false) || learned) return known();
  return std::nullopt;
}

ChannelNoise StandstillNoise::known() const noexcept {
  if (options_.calibrated) return calibrated_noise(*options_.calibrated, rate_hz_);
  if (!options_.use_learned) return {};
  return channel_noise(NoiseSource::kStandstill, learner_.models());
}

void StandstillNoise::reset_segment() noexcept { learner_.interrupt(); }

}  // namespace gyrod::stream
