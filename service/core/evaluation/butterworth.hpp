/// Butterworth low-passes as cascades of second-order sections.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::core {

/// y[t] = b0 x[t] + b1 x[t-1] + b2 x[t-2] - a1 y[t-1] - a2 y[t-2]. A first-order section has b2 = a2 = 0.
struct FilterSection {
  double b0 = 1.0;
  double b1 = 0.0;
  double b2 = 0.0;
  double a1 = 0.0;
  double a2 = 0.0;
};

/// The Butterworth low-pass of an order by the bilinear transform with the cut-off prewarped, K = tan(pi fc/fs):
///   |H(f)|^2 = 1 / (1 + (tan(pi f/fs) / K)^(2 order)).
/// Gain 1 at frequency 0, 1/sqrt(2) at the cut-off. Even orders have order/2 sections with Q_k = 1 / (2 sin((2k-1) pi / (2 order)));
/// odd ones a first-order section besides. Source: Oppenheim, Schafer, "Discrete-time signal processing", chapter 7.
/// @param cutoff fc/fs, cycles per sample  @pre 1 <= order <= 16, 0 < cutoff < 0.5
[[nodiscard]] std::vector<FilterSection> butterworth(std::size_t order, double cutoff);

/// Filters in place, forward in time. Starts as if x[0] had been there for ever: an offset does not ring.
/// Allocates nothing. @pre x is finite; every section has gain 1 at frequency 0
void filter_forward(std::span<const FilterSection> sections, std::span<double> x) noexcept;

/// Forward and then backward in time: no phase shift, gain |H|^2, so half at the cut-off. Both ends are prolonged by their reflection
/// in the end point (2 x[0] - x[k]) over 1.5 periods of the cut-off, as far as the series reaches, and cut off again.
/// @pre x is finite; every section has gain 1 at frequency 0
[[nodiscard]] std::vector<double> filter_zero_phase(std::span<const FilterSection> sections, double cutoff,
                                                    std::span<const double> x);

}  // namespace gyrod::core
