#include "app/evaluated_methods.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "app/angle_units.hpp"
#include "app/joint_contender.hpp"
#include "app/options.hpp"
#include "app/record_denoiser.hpp"
#include "core/denoise/scheme.hpp"
#include "core/joint/joint_options.hpp"
#include "files/record.hpp"

namespace gyrod::app {
namespace {

constexpr const char* kJoint = "joint";
constexpr const char* kRealtime = "realtime";

/// One axis as a recording.
files::Record record_of(std::span<const double> noisy_dps, double rate_hz) {
  files::Record record;
  record.sample_rate_hz = rate_hz;
  for (std::size_t n = 0; n < noisy_dps.size(); ++n) {
    record.time_s.push_back(static_cast<double>(n) / rate_hz);
    record.gyro_radps[0].push_back(kRadPerDeg * noisy_dps[n]);
  }
  return record;
}

core::Method two_speed_method(const std::string& name, const MethodContext& context) {
  JointRun run;
  run.sample_rate_hz = context.rate_hz;
  run.window_samples = context.settings.engine.window_samples;
  run.doublings = stream::doublings_at(context.settings.engine, context.rate_hz);
  run.options = joint_options(context.settings);
  run.max_signal_hz = context.settings.denoise.max_signal_hz;
  run.lag_samples = context.lag_samples;
  run.realtime = answers_at_once(name);
  if (context.sensor) run.noise = context.sensor->noise;
  run.noise[context.axis] = context.noise;
  const auto estimate = [run, axis = context.axis, sensor = context.sensor,
                         learns = context.learns_itself](std::span<const double> noisy_dps) {
    std::array<std::span<const double>, stream::kAxes> axes;
    if (sensor) std::ranges::copy(sensor->noisy_dps, axes.begin());
    axes[axis] = noisy_dps;
    if (!learns) return joint_contender(run, axis, axes);
    JointRun own = run;
    own.noise[axis] = learned_at_rest({noisy_dps, {}, {}}, run.sample_rate_hz)[0];
    return joint_contender(own, axis, axes);
  };
  return {name, run.realtime ? 0 : context.lag_samples, estimate};
}

}  // namespace

std::vector<std::string> evaluated_method_names() {
  std::vector<std::string> names;
  for (const core::Scheme scheme : core::kAllSchemes) {
    if (scheme != core::Scheme::kRaw) names.emplace_back(core::name_of(scheme));
  }
  names.emplace_back(kJoint);
  names.emplace_back(kRealtime);
  return names;
}

bool answers_at_once(const std::string& name) noexcept { return name == kRealtime; }

bool takes_noise_model(const std::string& name) noexcept { return name == kJoint || name == kRealtime; }

std::size_t largest_lag(const std::string& name, const settings::Settings& settings) {
  return takes_noise_model(name) ? core::kMaxLag : settings.engine.window_samples / 4;
}

core::Method evaluated_method(const std::string& name, const MethodContext& context) {
  if (takes_noise_model(name)) return two_speed_method(name, context);
  settings::Settings settings = context.settings;
  settings.engine.lag_samples = context.lag_samples;
  settings.noise.source = settings::NoiseSource::kImf1;  // the paper's schemes know no other
  const auto run = [name, settings, rate_hz = context.rate_hz](std::span<const double> noisy_dps) {
    core::Contender contender;
    contender.name = name;
    contender.lag_samples = settings.engine.lag_samples;
    contender.seams = core::seams_every(settings.engine.hop_samples, settings.engine.lag_samples);
    auto rates = denoise_record(record_of(noisy_dps, rate_hz), settings,
                                core::scheme_of(name).value_or(core::Scheme::kRaw), false);
    contender.estimate = std::move(rates[0]);
    for (double& value : contender.estimate) value /= kRadPerDeg;
    return contender;
  };
  return {name, context.lag_samples, run};
}

}  // namespace gyrod::app
