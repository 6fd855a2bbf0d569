#include "app/evaluated_methods.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "app/angle_units.hpp"
#include "app/joint_contender.hpp"
#include "app/options.hpp"
#include "app/record_denoiser.hpp"
#include "app/remembered_runs.hpp"
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

JointRun joint_run(const MethodContext& context) {
  JointRun run;
  run.sample_rate_hz = context.rate_hz;
  run.window_samples = context.settings.engine.window_samples;
  run.doublings = stream::doublings_at(context.settings.engine, context.rate_hz);
  run.options = joint_options(context.settings);
  run.max_signal_hz = context.settings.denoise.max_signal_hz;
  if (context.sensor) run.noise = context.sensor->noise;
  run.noise[context.axis] = context.noise;
  return run;
}

/// All of `answers` to a record.
RememberedRuns::Run two_speed_runs(const MethodContext& context, std::vector<JointAnswer> answers) {
  return [run = joint_run(context), answers = std::move(answers), axis = context.axis,
          sensor = context.sensor, learns = context.learns_itself](std::span<const double> noisy_dps) {
    std::array<std::span<const double>, stream::kAxes> axes;
    if (sensor) std::ranges::copy(sensor->noisy_dps, axes.begin());
    axes[axis] = noisy_dps;
    if (!learns) return joint_contenders(run, answers, axis, axes);
    JointRun own = run;
    own.noise[axis] = learned_from({noisy_dps, {}, {}}, run.sample_rate_hz)[0];
    return joint_contenders(own, answers, axis, axes);
  };
}

core::Method paper_method(const WantedMethod& wanted, const MethodContext& context) {
  settings::Settings settings = context.settings;
  settings.engine.lag_samples = wanted.lag_samples;
  settings.noise.source = settings::NoiseSource::kImf1;  // the paper's schemes know no other
  const auto run = [name = wanted.name, settings,
                    rate_hz = context.rate_hz](std::span<const double> noisy_dps) {
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
  return {wanted.name, wanted.lag_samples, run};
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

std::vector<core::Method> evaluated_methods(const std::vector<WantedMethod>& wanted,
                                            const MethodContext& context, std::size_t records) {
  std::vector<JointAnswer> answers;
  for (const WantedMethod& one : wanted) {
    if (takes_noise_model(one.name)) answers.push_back({one.lag_samples, answers_at_once(one.name)});
  }
  const auto runs = std::make_shared<RememberedRuns>(two_speed_runs(context, answers), records);
  std::vector<core::Method> methods;
  std::size_t answer = 0;
  for (const WantedMethod& one : wanted) {
    if (!takes_noise_model(one.name)) {
      methods.push_back(paper_method(one, context));
      continue;
    }
    const auto run = [runs, answer](std::span<const double> noisy) { return runs->answer(noisy, answer); };
    methods.push_back({one.name, answers_at_once(one.name) ? 0 : one.lag_samples, run});
    ++answer;
  }
  return methods;
}

core::Method evaluated_method(const WantedMethod& wanted, const MethodContext& context) {
  return std::move(evaluated_methods({wanted}, context).front());
}

}  // namespace gyrod::app
