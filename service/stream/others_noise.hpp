/// What the axes of a sensor tell of each other's noise.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/explained_share.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// Whether most samples are what the one before was: an axis that is dead, or hangs, and what its model once found is no sensor's noise.
[[nodiscard]] inline bool hardly_changes(std::span<const double> samples) noexcept {
  std::size_t same = 0;
  for (std::size_t n = 1; n < samples.size(); ++n) same += samples[n] == samples[n - 1] ? 1U : 0U;
  return 2 * same > samples.size();
}

/// Sets WindowInput::others_noise. Axes that hardly change do not count.
/// @param noise variance that the models of the axes have found so far; 0 where one has none
inline void tell_others_noise(std::array<WindowInput, kAxes>& windows,
                              std::array<double, kAxes> noise) noexcept {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    if (hardly_changes(windows[axis].samples)) noise[axis] = 0.0;
  }
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    windows[axis].others_noise = core::least_of_others(noise, axis);
}

}  // namespace gyrod::stream
