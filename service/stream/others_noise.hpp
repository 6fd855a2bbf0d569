/// What the axes of a sensor tell of each other's noise.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/quietest_axis.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// Whether most samples are what the one before was: an axis that is dead, or hangs, and what its model once found is no sensor's noise.
[[nodiscard]] inline bool hardly_changes(std::span<const double> samples) noexcept {
  std::size_t same = 0;
  for (std::size_t n = 1; n < samples.size(); ++n) same += samples[n] == samples[n - 1] ? 1U : 0U;
  return 2 * same > samples.size();
}

/// What is quieter than every other axis by this much, as a variance, is made, not measured: a planar robot in a simulator.
inline constexpr double kNoNoise = 1e-3;

/// Sets WindowInput::others_noise. Axes that hardly change, and such that have no noise, do not count.
/// @param noise variance that the models of the axes have found so far; 0 where one has none
inline void tell_others_noise(std::array<WindowInput, kAxes>& windows,
                              std::array<double, kAxes> noise) noexcept {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (hardly_changes(windows[axis].samples)) noise[axis] = 0.0;
  }
  const auto quiet = [noise](std::size_t axis) {
    const double others = core::least_of_others(noise, axis);
    return others > 0.0 && noise[axis] < kNoNoise * others;
  };
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (quiet(axis)) noise[axis] = 0.0;
  }
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    windows[axis].others_noise = core::least_of_others(noise, axis);
}

}  // namespace gyrod::stream
