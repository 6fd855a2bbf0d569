/// Tells where in a spectrum a sensor's noise is alone, behind the sensor's own low-pass.
#pragma once

#include <cstddef>
#include <optional>

#include "core/noise/axis_bands.hpp"

namespace gyrod::core {

/// Sums over some segments of what their spectra have in each band.
struct AxisDensities {
  AxisBands::Axes own{};     ///< mean density
  AxisBands::Axes shared{};  ///< mean product of the two other axes, in phase (CrossPower)
  double count = 0.0;        ///< segments
};

/// From some band on, two stretches that follow one another hold noise alone.
struct NoiseAlone {
  std::size_t first = 0;         ///< that band
  AxisBands::Likeness likeness;  ///< from it on
  double flat_density = 0.0;     ///< of its middle axis, where that is flat
  AxisBands::Axes density{};     ///< mean over both stretches, of all bands

  /// Whether the band is one of these, and has enough to tell something.
  [[nodiscard]] bool tells(std::size_t band) const noexcept {
    return AxisBands::tells(likeness, band, flat_density);
  }
};

/// Behind a low-pass a spectrum has no floor that would tell the noise, but often a part that holds nothing else: what is faster than the motion. Sought
/// is the slowest band from which on spectra are
///   flat, then falling:  no band rises by more than chance; at one and a half times the frequency of the first there is 0.3 of it at least; what is
///            flat reaches `motion_bins`; the last has less than a tenth of that, and less than 0.75 of the one before or a fiftieth of what is flat. Noise
///            that is as dense at all slower bands would have a statistical bandwidth (AxisBands::bandwidth()) of at most 0.7;
///   alike:   the same on all axes, to a factor of 3 (AxisBands::alike());
///   own:     less than a tenth of each is explained by the others, as what shakes a body is seen by all of them at once;
///   least:   at most 1.5 times what the bands have had at their quietest, but for chance, as motion comes and goes;
///   steady:  in both stretches as much.
/// Noise with a floor is none of that.
/// @param least density that each band has had in two such stretches, infinite where none was seen
/// @param motion_bins bins that motion may fill, as that of bodies which turn smoothly is so shaped
/// @return nothing where there is none, or not all axes are alive
/// @pre both counts are above 0
/// Source: docs/joint.md, "Noise that a low-pass hides".
[[nodiscard]] std::optional<NoiseAlone> find_noise_alone(const AxisBands& bands, const AxisDensities& before,
                                                         const AxisDensities& now,
                                                         const AxisBands::Axes& least,
                                                         double motion_bins) noexcept;

}  // namespace gyrod::core
