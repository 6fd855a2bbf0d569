#include "app/noise_course.hpp"

#include <algorithm>
#include <memory>

#include "app/angle_units.hpp"
#include "stream/standstill_noise.hpp"

namespace gyrod::app {

NoiseCourse known_throughout(const core::NoiseModel& model) { return {{0, model, false}}; }

core::NoiseModel known_at(const NoiseCourse& course, std::size_t end) noexcept {
  const auto next = std::ranges::upper_bound(course, end, {}, &KnownNoise::from_sample);
  return next == course.begin() ? core::NoiseModel{} : std::prev(next)->model;
}

std::array<NoiseCourse, stream::kAxes> learned_from(
    const std::array<std::span<const double>, stream::kAxes>& rates_dps, double rate_hz) {
  stream::StandstillOptions options;
  options.sample_rate_hz = rate_hz;
  const auto learner = std::make_unique<stream::StandstillNoise>(options);
  const std::size_t samples = std::ranges::max(rates_dps, {}, &std::span<const double>::size).size();
  std::array<NoiseCourse, stream::kAxes> courses;
  for (std::size_t n = 0; n < samples; ++n) {
    stream::Sample sample;
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      if (!rates_dps[axis].empty()) sample.rate_radps[axis] = kRadPerDeg * rates_dps[axis][n];
    }
    learner->step(sample, true, rate_hz);
    const auto noise = learner->update();
    if (!noise) continue;
    // Of a source kNone the models are not usable: what was learned is forgotten.
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
      courses[axis].push_back(
          {n + 1, core::scaled(noise->axis[axis], kDegPerRad), noise->source == stream::NoiseSource::kImf1});
  }
  return courses;
}

}  // namespace gyrod::app
