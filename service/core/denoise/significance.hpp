/// Is the energy of an IMF that of white noise? How it scatters from window to window, and the test made of it.
#pragma once

#include <cstddef>

#include "core/denoise/window_report.hpp"

namespace gyrod::core {

/// Degrees of freedom of the energy of IMF i of N samples of white noise:
///   nu_i = a_i N / T_i,   at least 1,
/// E_i is distributed nearly as its mean times chi-squared(nu_i) / nu_i. T_i is the mean period on the noise
/// line and a_i a table near 1 (significance.cpp says how it was made): an IMF holds about N / T_i independent
/// waves. Measured for 10 sifts and the mirror rule, N = 512 to 4096, like the noise line.
/// Source of the form: Wu, Huang, "A study of the characteristics of white noise using the empirical mode
/// decomposition method" (2004).
/// @param imf 1 for the fastest  @param samples N
[[nodiscard]] double noise_freedom(std::size_t imf, std::size_t samples) noexcept;

/// An interval of the excess q = E / (s^2 e_i).
struct NoiseBand {
  double lower = 0.0;
  double upper = 0.0;
};

/// Two-sided test of the excess. With v = 2 / (9 nu) the cube root of q is nearly normal with mean 1 - v and variance v (Wilson,
/// Hilferty 1931); the band is where it lies but for the false-alarm rate, half of it on either side.
class SignificanceTest {
 public:
  /// @param false_alarm_rate of one IMF  @throws std::invalid_argument unless inside 1e-6 .. 0.5
  explicit SignificanceTest(double false_alarm_rate);

  /// Excess that white noise has, but for the false-alarm rate. The lower bound is 0 where nu is small.
  [[nodiscard]] NoiseBand band(std::size_t imf, std::size_t samples) const noexcept;

  /// Puts band and probability of the figures' excess beside it.
  void judge(ImfFigures& figures, std::size_t imf, std::size_t samples) const noexcept;

  /// Probability that white noise gives an excess at least as far from its mean as this one. 0 where it is not a number: energies of
  /// values near 1e300 overflow.
  [[nodiscard]] static double p_value(double excess, std::size_t imf, std::size_t samples) noexcept;

 private:
  double deviations_;  ///< half-width of the band, standard deviations of the cube root
};

}  // namespace gyrod::core
