/// The line in a sensor's own noise, and what may be it.
#pragma once

#include <cstddef>
#include <span>

#include "core/joint/spectral_mode.hpp"

namespace gyrod::core {

/// The narrow peak of a noise spectrum. A plain value; power 0 where there is none.
struct NoisePeak {
  /// A sensor's line wanders with temperature (noise/line_spread.hpp); at start-up it can be a tenth from where it settles. The fit then finds a
  /// mode beside the line that it was told, which is no motion.
  /// Chosen by joint_study (docs/method.md, "Noise lines that wander"): at 0.15 the line of imu1 z is kept as motion, 0.3 serves a little better still, and
  /// costs more of what may be motion.
  static constexpr double kReach = 0.25;
  /// The line is at most this many times as strong as believed, in a window that is too short to tell. From the same place: at 1.0 some of
  /// it is kept as motion, at 2 motion is lost where a road shakes at its frequency.
  static constexpr double kMostPower = 1.25;

  double cycles = 0.0;        ///< its frequency, cycles per sample
  double power = 0.0;         ///< variance of what stands above the spectrum around it
  double surroundings = 0.0;  ///< mean of the spectrum further away than kReach of its frequency
  /// Bins [first, end) of that spectrum are within reach.
  std::size_t first_bin = 0;
  std::size_t end_bin = 0;

  /// Whether the line may have moved to this frequency.
  [[nodiscard]] bool reaches(double centre_cycles) const noexcept;
};

/// The highest point above 1/40 cycle per sample, where slow noise does not count, if it stands 2.5 times as high as the mean of what is further away than
/// kReach of its frequency.
/// @param spectrum power at equally spaced frequencies from 0 to half a cycle per sample; mean of all bins = variance. At least 64 bins
[[nodiscard]] NoisePeak noise_peak(std::span<const double> spectrum) noexcept;

/// A mode within reach of the line, and its variance.
struct ModeNearLine {
  SpectralMode* mode = nullptr;
  double power = 0.0;
};

/// Sets the share of each mode. What is missing of the line where it is believed to be, up to kMostPower of its power in all, is in the modes: in
/// the narrowest, which is most like a line, as far as that goes, then in the next; the rest of them is motion. A mode that is more than all
/// of this is motion as well, and where it is twice as much, only what is missing of the line's believed power is in it.
/// @param expected the line's power where it is believed to be (WhittleFit::expected_line)
/// @param modes their powers above 0; reordered
void share_with_line(const NoisePeak& peak, double expected, std::span<ModeNearLine> modes) noexcept;

}  // namespace gyrod::core
