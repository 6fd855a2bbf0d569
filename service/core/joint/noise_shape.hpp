/// What noise of unknown colour is likely to be, from the power of a few bands.
#pragma once

#include <array>
#include <cstddef>

#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Bands of equal width between 0 and half the sample rate, in which noise is told from motion.
inline constexpr std::size_t kNoiseBands = 8;
using BandPower = std::array<double, kNoiseBands>;
/// Of a sensor with one axis: it shares nothing.
inline constexpr BandPower kAllOwn = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};

/// Noise whose spectrum falls with frequency as that of a gyro with a low-pass above half its sample rate does: (1 - tilt) white,
/// tilt of an AR(1) process with coefficient 0.25, which is 2.8 times as strong at 0 as at half the rate.
struct NoiseShape {
  double level = 1.0;  ///< variance, in parts of a unit's
  double tilt = 0.0;   ///< 0..0.9
};

/// The mean of level and tilt over what may be, each weighed by how likely the bands are with it. A band holds noise alone, 3 in 5, or motion,
/// too: with x = ln(power / noise's) its likelihood is
///   0.6 N(x; 0, 0.1^2) + 0.4 p(x),   p(x) = exp(-x / 0.6) / 0.6 above 0, and falls as the normal density below;
/// where a level is believed, with one in five all bands together have a mean excess of 2 for 0.6: a car that shakes.
/// Level and tilt go in steps of 0.05 in ln(level), 0.1; a tilt is likely as exp(-tilt / 0.3), as there are gyros with white noise and with 0.7.
/// Source: docs/joint.md, "When the noise is not as believed"; docs/decisions/0007.
/// @param power mean power of each band, in a unit in which it is 1 where there is white noise as believed and nothing else
/// @param known whether such a level is believed: then ln(level) is likely as N(0, 0.3^2), within -1 and 1.5; otherwise any level is, within these of
///   the quietest band
/// @return level 0 where nothing is known and a band is empty
[[nodiscard]] NoiseShape likely_shape(const BandPower& power, bool known) noexcept;

/// How many of the bands hold as much as noise of that shape alone would, within two of the deviations above.
/// @pre shape.level > 0; no band is negative
[[nodiscard]] std::size_t bands_of_noise_alone(const BandPower& power, const NoiseShape& shape) noexcept;

/// Noise of that shape.
[[nodiscard]] NoiseModel noise_of(const NoiseShape& shape) noexcept;

}  // namespace gyrod::core
