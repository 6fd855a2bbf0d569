#include "core/inertial/dead_reckoning.hpp"

#include <cassert>

namespace gyrod::core {
namespace {

Eigen::Vector3d vector_at(const std::array<std::span<const double>, 3>& axes, std::size_t index) noexcept {
  return {axes[0][index], axes[1][index], axes[2][index]};
}

}  // namespace

InertialSample sample_of(const InertialSeries& series, std::size_t index, const SensorBias& bias) noexcept {
  const std::size_t delay = series.rate_delay_samples;
  return {vector_at(series.rate_radps, index > delay ? index - delay : 0) - bias.gyro_radps,
          vector_at(series.specific_force_mps2, index) - bias.accel_mps2};
}

InertialSample mean_of(const InertialSeries& series, std::size_t first, std::size_t end) noexcept {
  assert(first < end && end <= series.size());
  InertialSample sum;
  for (std::size_t n = first; n < end; ++n) {
    const InertialSample sample = sample_of(series, n, {});
    sum.rate_radps += sample.rate_radps;
    sum.specific_force_mps2 += sample.specific_force_mps2;
  }
  const auto count = static_cast<double>(end - first);
  return {sum.rate_radps / count, sum.specific_force_mps2 / count};
}

std::vector<NavigationState> dead_reckoned(const InertialSeries& series, std::size_t first, std::size_t end,
                                           const NavigationState& start, const SensorBias& bias) {
  assert(first < end && end <= series.size());
  std::vector<NavigationState> states;
  states.reserve(end - first);
  states.push_back(start);
  InertialSample before = sample_of(series, first, bias);
  for (std::size_t n = first + 1; n < end; ++n) {
    const InertialSample now = sample_of(series, n, bias);
    const double dt_s = series.time_s[n] - series.time_s[n - 1];
    states.push_back(strapdown_step(states.back(), increment_between(before, now, dt_s), dt_s));
    before = now;
  }
  return states;
}

}  // namespace gyrod::core
