/// A swing that answers give too small or too large, for tests of what corrects that.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

namespace gyrod::testing {

inline constexpr double kSwingPeriod = 240.0;  // samples: 0.5 Hz at the design's rate

inline double swing(double n) { return std::sin(2.0 * std::numbers::pi * n / kSwingPeriod); }

/// Of y <- y + (x - y) / samples, for the swing.
inline std::complex<double> low_pass(double samples) {
  const std::complex<double> back = std::polar(1.0, -2.0 * std::numbers::pi / kSwingPeriod);
  return (1.0 / samples) / (1.0 - (1.0 - 1.0 / samples) * back);
}

/// What is added in parts of the answer, over ten periods: of its component in phase.
/// @param answer n -> what is corrected
/// @param added n -> what it was given
template <typename Answer, typename Added>
double share_in_phase(int begin, const Answer& answer, const Added& added) {
  double in_phase = 0.0;
  double power = 0.0;
  for (int n = begin; n < begin + 10 * static_cast<int>(kSwingPeriod); ++n) {
    const double x = answer(n);
    in_phase += added(n) * x;
    power += x * x;
  }
  return in_phase / power;
}

}  // namespace gyrod::testing
