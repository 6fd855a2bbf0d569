/// How strong a sensor's noise can be, by its first samples.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/joint/quietest_axis.hpp"

namespace gyrod::core {

/// Fourth differences of white noise have 70 times its variance, and of slow motion hardly any; shaking they make larger. So those of each axis are
/// regressed on those of the two others: what is left is still no less than the axis's own noise, and of a body that shakes far less than all.
/// And the axes of a sensor have noise of a size. Until the first model, where nothing else is known.
/// A plain value; allocates nothing. Source: docs/joint.md, "Before the first model".
class StartNoise {
 public:
  void reset() noexcept { *this = {}; }
  /// Takes a sample of each axis.
  void step(const std::array<double, kSensorAxes>& sample) noexcept;
  /// Most that the axis's noise can be, variance; infinite before there are samples enough to tell.
  [[nodiscard]] double most(std::size_t axis) const noexcept;

 private:
  static constexpr std::size_t kOrder = 4;
  std::array<std::array<double, kOrder>, kSensorAxes>
      last_{};        ///< sample, and its differences of orders 1 to 3
  CrossPower power_;  ///< of fourth differences
  std::uint64_t samples_ = 0;
};

}  // namespace gyrod::core
