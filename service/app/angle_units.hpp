/// Degrees are for people, radians for the computer.
#pragma once

#include <numbers>

namespace gyrod::app {

inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;
inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

}  // namespace gyrod::app
