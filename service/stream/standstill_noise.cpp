#include "stream/standstill_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/noise/noise_units.hpp"
#include "core/noise/same_noise.hpp"
#include "core/noise/still_noise.hpp"

namespace gyrod::stream {
namespace {

/// The learner has to be made for some rate before there is one; it takes no sample until then.
constexpr double kAnyRateHz = 100.0;

const core::NoiseModel* strongest(const std::array<core::NoiseModel, kAxes>& models) noexcept {
  const core::NoiseModel* found = nullptr;
  for (const core::NoiseModel& model : models) {
    if (!core::is_usable(model)) continue;
    if (found == nullptr || core::noise_variance(model) > core::noise_variance(*found)) found = &model;
  }
  return found;
}

/// @pre sample_rate_hz > 0
std::array<core::NoiseModel, kAxes> calibrated_models(const CalibratedNoise& calibrated,
                                                      double sample_rate_hz) noexcept {
  std::array<core::NoiseModel, kAxes> models = calibrated.models;
  for (core::NoiseModel& model : models) {
    if (core::is_usable(model)) model = core::at_rate(model, calibrated.sample_rate_hz, sample_rate_hz);
  }
  return models;
}

ChannelNoise calibrated_noise(const CalibratedNoise& calibrated, double sample_rate_hz) noexcept {
  return channel_noise(NoiseSource::kCalibrated, calibrated_models(calibrated, sample_rate_hz));
}

bool has_force(const Sample& sample) noexcept {
  return sample.specific_force_mps2 &&
         std::ranges::all_of(*sample.specific_force_mps2, [](double value) { return std::isfinite(value); });
}

/// Lines alone, where no axis has more.
ChannelNoise noise_in_motion(const std::array<core::NoiseModel, kAxes>& models) noexcept {
  if (std::ranges::any_of(models, core::is_usable)) return channel_noise(NoiseSource::kImf1, models);
  if (std::ranges::all_of(models, [](const core::NoiseModel& model) { return model.line_count == 0; }))
    return {};
  ChannelNoise noise{NoiseSource::kImf1, {}};
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    noise.axis[axis] = core::scaled(models[axis], core::kNoiseMargin);
  return noise;
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
  if (!core::is_same_rate(options.remembered->sample_rate_hz, rate_hz)) return {};
  return channel_noise(NoiseSource::kStandstill, options.remembered->models);
}

StandstillNoise::StandstillNoise(StandstillOptions options)
    : options_(std::move(options)),
      rate_hz_(first_rate(options_)),
      learner_(rate_hz_ > 0.0 ? rate_hz_ : kAnyRateHz) {
  if (options_.remembered && learner_.restore(*options_.remembered))
    allan_.restore(options_.remembered->curves);
  revision_ = learner_.revision();
  learned_at_rest_ = std::ranges::any_of(learner_.models(), core::is_usable);
  rest_seconds_ = learner_.rest_seconds();
  if (!options_.calibrated && options_.use_learned && options_.learns_in_motion)
    hidden_.emplace(rate_hz_ > 0.0 ? rate_hz_ : kAnyRateHz);
}

void StandstillNoise::step(const Sample& sample, bool measured, double sample_rate_hz) noexcept {
  fresh_ = false;
  follow_rate(sample_rate_hz);
  if (!(rate_hz_ > 0.0)) return;
  if (measured)
    allan_.step(sample.rate_radps);
  else
    allan_.interrupt();
  if (learner_.step(sample.rate_radps, force_at(sample, measured), measured)) end_block();
  if (hidden_) listen_in_motion(sample, measured);
}

/// As long as nothing better is known.
void StandstillNoise::listen_in_motion(const Sample& sample, bool measured) noexcept {
  if (!learned_at_rest_)
    hidden_->step(sample.rate_radps, measured);
  else if (listening_)
    hidden_->interrupt();
  listening_ = !learned_at_rest_;
}

/// Nothing where the accelerometer has failed, or has none to give, for more than a moment.
const core::Triple* StandstillNoise::force_at(const Sample& sample, bool measured) noexcept {
  if (measured && has_force(sample)) {
    force_mps2_ = *sample.specific_force_mps2;
    held_ = 0;
  } else if (held_ <= kMostHeldForces) {
    ++held_;
  }
  if (held_ > kMostHeldForces) {
    doubted_ = kForcesAgain;
    return nullptr;
  }
  if (doubted_ == 0) return &force_mps2_;
  --doubted_;
  return nullptr;
}

void StandstillNoise::end_block() noexcept {
  // What was learned was no rest, or a sensor that is no more: so were the samples of the curve.
  const bool began_anew = learner_.rest_seconds() < rest_seconds_;
  rest_seconds_ = learner_.rest_seconds();
  if (began_anew) allan_.clear();
  allan_.end_block(learner_.at_rest());
  const core::RestDetector& detector = learner_.detector();
  evidence_.block_s = static_cast<double>(detector.block_samples()) / rate_hz_;
  evidence_.looks_at_rest = detector.verdict() == core::RestVerdict::kRest;
  evidence_.mean_radps = detector.mean();
  evidence_.bias_radps = learner_.bias();
  evidence_.bias_s = learner_.state().bias_seconds;
  evidence_.sample_rate_hz = rate_hz_;
  evidence_.curves = allan_.curves();
  const auto usual =
      options_.calibrated ? calibrated_models(*options_.calibrated, rate_hz_) : learner_.models();
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    evidence_.deviation_radps[axis] = std::sqrt(detector.variance()[axis]);
    evidence_.usual_deviation_radps[axis] =
        core::is_usable(usual[axis]) ? std::sqrt(core::noise_variance(usual[axis])) : 0.0;
  }
  fresh_ = true;
}

void StandstillNoise::follow_rate(double sample_rate_hz) noexcept {
  if (!(sample_rate_hz > 0.0) || core::is_same_rate(sample_rate_hz, rate_hz_)) {
    agreeing_ = 0;
    return;
  }
  if (agreeing_ == 0 || !core::is_same_rate(sample_rate_hz, other_rate_hz_)) {
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
  if (hidden_) hidden_->retime(sample_rate_hz);
  allan_.clear();
  rest_seconds_ = 0.0;
}

std::optional<ChannelNoise> StandstillNoise::update() noexcept {
  const bool learned = learner_.revision() != revision_;
  revision_ = learner_.revision();
  if (learned) learned_at_rest_ = std::ranges::any_of(learner_.models(), core::is_usable);
  if (learned && options_.on_learned) options_.on_learned({learner_.state(), allan_.curves()});
  const std::uint64_t heard = hidden_ ? hidden_->revision() : 0;
  const bool hidden_changed = std::exchange(hidden_revision_, heard) != heard && !learned_at_rest_;
  if (std::exchange(rate_changed_, false) || learned || hidden_changed) return known();
  return std::nullopt;
}

ChannelNoise StandstillNoise::known() const noexcept {
  if (options_.calibrated) return calibrated_noise(*options_.calibrated, rate_hz_);
  if (!options_.use_learned) return {};
  const bool at_rest = !hidden_ || learned_at_rest_;
  return at_rest ? channel_noise(NoiseSource::kStandstill, learner_.models())
                 : noise_in_motion(hidden_->models());
}

void StandstillNoise::reset_segment() noexcept {
  learner_.interrupt();
  if (hidden_) hidden_->interrupt();
  allan_.interrupt();
  held_ = kMostHeldForces + 1;
}

}  // namespace gyrod::stream
