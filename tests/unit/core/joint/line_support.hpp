/// Noise with a line, for the tests of what follows it.
#pragma once

#include <cmath>
#include <numbers>

#include "core/noise/noise_model.hpp"

namespace gyrod::testing {

/// Radius of the poles of a resonance that is a line: 0.005 cycles per sample to either side at half its height.
inline constexpr double kLineRadius = 0.97;

/// A line at `cycles` per sample of variance `power`, as wide as such a resonance.
inline core::SpectralLine line(double cycles, double power) {
  return {
      .cycles = cycles, .half_width = -std::log(kLineRadius) / (2.0 * std::numbers::pi), .variance = power};
}

/// White noise of variance 1 and that line.
inline core::NoiseModel noise_with_line(double cycles, double power) {
  core::NoiseModel model = core::white_noise(1.0);
  model.line_count = 1;
  model.line[0] = line(cycles, power);
  return model;
}

/// The same noise as its samples have it: white noise of variance 1 and the resonance.
inline core::NoiseModel noise_with_resonance(double cycles, double power) {
  core::NoiseModel model = core::white_noise(1.0);
  model.colour_order = 2;
  model.colour = {2.0 * kLineRadius * std::cos(2.0 * std::numbers::pi * cycles), -kLineRadius * kLineRadius};
  model.colour_variance = 1.0;
  model.colour_variance = power / (core::noise_variance(model) - 1.0);
  return model;
}

}  // namespace gyrod::testing
