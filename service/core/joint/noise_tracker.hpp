/// Watches whether a channel's noise is what it is believed to be, and corrects it within bounds.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Per band of equal width between 0 and half the sample rate, the mean of I / R over the bins and over about the last three windows'
/// length: the observed power in parts of the noise's. Where there is nothing but noise, that is 1. A band far above is motion and
/// says nothing about the noise; the others tell level and colour.
/// A plain value; allocates nothing.
class NoiseTracker {
 public:
  static constexpr std::size_t kBands = 8;

  /// Takes the periodogram of a window and the noise's spectrum at the same frequencies, in the same unit.
  /// @param share how much of a window is new since the last one, 0..1: hop / window
  /// @param known whether `noise` is believed, or only a unit; what was remembered of the other kind is forgotten
  void observe(std::span<const double> periodogram, std::span<const double> noise, bool known,
               double share) noexcept;

  /// Power of the noise in parts of the believed one, from the bands that do not hold motion: their mean where that is below 1, at
  /// least one half. Above 1 the smaller of mean^1.5 and (mean of the quietest three)^6, and at least 1. Not above 1 where half of
  /// the bands hold motion: on a rough road every band holds some.
  [[nodiscard]] double level() const noexcept;

  /// Mean power of the bands that are as quiet as the quietest, within 2.5 of it; at least the quietest's, raised by what the least of
  /// kBands estimates lies below their mean.
  [[nodiscard]] double floor() const noexcept;

  /// True where the level is so far from 1 that the believed noise is wrong.
  [[nodiscard]] bool disagrees() const noexcept;

 private:
  std::array<double, kBands> ratio_{};
  double weight_ = 0.0;  ///< of what was observed, in windows
  bool known_ = false;
};

}  // namespace gyrod::core
