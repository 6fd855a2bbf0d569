/// A sensor with a low-pass of its own, in motion.
#pragma once

#include <array>
#include <cstddef>

#include "support/signals.hpp"

namespace gyrod::testing {

inline constexpr double kLowPassedHz = 400.0;

/// What a sensor of kLowPassedHz measures and what it would without noise, deg/s.
struct LowPassed {
  std::array<Signal, 3> measured;
  std::array<Signal, 3> truth;
};

/// y[t] = 0.64 y[t-1] + 0.36 x[t], twice: 33 Hz at half the power. White noise of variance 1 keeps 0.133 of it: sum of the squares of (n + 1) 0.36^2 0.64^n.
inline Signal two_poles(Signal x) {
  for (int pass = 0; pass < 2; ++pass) {
    double y = 0.0;
    for (double& value : x) value = y += 0.36 * (value - y);
  }
  return x;
}

/// Turns of 4 to 8 deg/s below 1 Hz on all axes, in noise of 0.3 deg/s before the low-pass: no moment of rest.
inline LowPassed low_passed_motion(std::size_t size, unsigned seed) {
  LowPassed sensor;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto turns = tone(size, 0.6 / kLowPassedHz * (1.0 + 0.2 * axis), axis);
    sensor.truth[axis] = two_poles(times(turns, 4.0 + 2.0 * axis));
    sensor.measured[axis] = sum(sensor.truth[axis], two_poles(white_noise(size, 3 * seed + axis)), 0.3);
  }
  return sensor;
}

}  // namespace gyrod::testing
