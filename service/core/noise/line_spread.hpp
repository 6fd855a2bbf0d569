/// Narrow lines of a sensor's noise, taken for as uncertain as they are.
#pragma once

#include "core/noise/noise_fit.hpp"

namespace gyrod::core {

/// How far a line may be from where it was seen, in parts of its frequency. Lines of MEMS gyros wander with temperature: that of an
/// ADIS16405 (imu1 z) falls from 22.5 to 19.7 Hz in the two hours after power-up, and wanders by a few per cent after that.
/// Chosen by joint_study (docs/measured.md, "Noise lines that wander"): 0.10 to 0.15 serve best, 0.25 is too wide.
inline constexpr double kLineSpread = 0.15;

/// The spectrum with the power of every frequency spread evenly over those within kLineSpread of it; the whole keeps its power. Shapes
/// broader than that, the sensor's low-pass filter and white noise, stay what they are, and so do the lowest bins, with the bias.
/// Allocates nothing; about 2 us.
[[nodiscard]] NoiseSpectrum spread_lines(const NoiseSpectrum& power) noexcept;

}  // namespace gyrod::core
