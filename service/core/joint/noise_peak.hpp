/// The line in a sensor's own noise, and what may be it.
#pragma once

#include <span>

namespace gyrod::core {

/// The narrow peak of a noise spectrum. A plain value; power 0 where there is none.
struct NoisePeak {
  /// A sensor's line wanders with temperature (noise/line_spread.hpp); at start-up it can be a tenth from where it settles. The fit then finds a
  /// mode beside the line that it was told, which is no motion.
  /// Chosen by joint_study (docs/method.md, "Noise lines that wander"): at 0.15 the line of imu1 z is kept as motion, 0.3 serves a little better still, and
  /// costs more of what may be motion.
  static constexpr double kReach = 0.25;
  /// A mode is the line where it has at most this many times its power.
  static constexpr double kMostPower = 2.0;

  double cycles = 0.0;  ///< its frequency, cycles per sample
  double power = 0.0;   ///< variance of what stands above the spectrum around it

  /// Whether a mode at this frequency and of this variance can be the line at another place.
  [[nodiscard]] bool may_be(double centre_cycles, double mode_power) const noexcept;
};

/// The highest point above 1/40 cycle per sample, where slow noise does not count, if it stands 2.5 times as high as the mean of what is further away than
/// kReach of its frequency.
/// @param spectrum power at equally spaced frequencies from 0 to half a cycle per sample; mean of all bins = variance. At least 64 bins
[[nodiscard]] NoisePeak noise_peak(std::span<const double> spectrum) noexcept;

}  // namespace gyrod::core
