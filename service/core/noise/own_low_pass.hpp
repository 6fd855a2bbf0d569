/// Tells noise that a sensor's own low-pass filter has shaped from motion, by the spectra of its three axes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/noise/axis_bands.hpp"
#include "core/signal/periodogram.hpp"

namespace gyrod::core {

/// Sensors low-pass what they measure (`DLPF`, `LPF1`), often far below half the sample rate. Of such noise n samples tell no more than
/// fewer white ones do: block variances spread as those of n times independent() white samples, and block means have slow() times the
/// variance that white noise of the same level would have. Two numbers for RestDetector, 1 and 1 unless the spectra look like that:
///   narrow:  (sum of S)^2 / (sum of S^2) is at most half the bins: equivalent statistical bandwidth, Bendat and Piersol, "Random Data";
///   flat, then falling: no band stands above the one before by more than chance, three bands at least are alike at the slow end, and the last has less
///            than a tenth of these;
///   alike:   so on all axes: each is that of the middle one of three, but for a line of its own in two bands.
/// Roads, hands and engines have other shapes: each axis its own, with humps, or without a flat part.
///
/// By AxisBands of the last five to eight segments, and four to eight seconds of them at least. What they say is kept for four segments that say nothing.
/// About 14 kB; nothing allocates after construction. One thread at a time.
class OwnLowPass {
 public:
  /// @pre sample_rate_hz > 0
  explicit OwnLowPass(double sample_rate_hz);

  /// One sample of three axes, finite. @param periodogram of kNoiseSegment samples, for what happens at the end of a segment
  void step(const std::array<double, 3>& sample, Periodogram& periodogram) noexcept;
  /// A gap: what follows does not join what was.
  void interrupt() noexcept;
  /// The sample rate turns out to be another: begins anew with it. @pre sample_rate_hz > 0
  void retime(double sample_rate_hz) noexcept;

  /// Part of the samples that tells something new, above 0, at most 1.
  [[nodiscard]] double independent() const noexcept { return shape_.independent; }
  /// Density of the flat part over the mean density, at least 1.
  [[nodiscard]] double slow() const noexcept { return shape_.slow; }

 private:
  struct Shape {
    double independent = 1.0;
    double slow = 1.0;
  };
  /// Sums over so many segments, of mean densities in the bands.
  struct Spectra {
    AxisBands::Axes axes{};
    double count = 0.0;
  };

  void end_segment(Periodogram& periodogram) noexcept;
  void judge() noexcept;

  AxisBands bands_;
  std::array<std::vector<double>, 3> segment_;
  std::size_t in_segment_ = 0;
  double enough_ = 0.0;  ///< segments of a half
  Spectra this_half_;
  Spectra last_half_;
  Shape shape_;
  std::size_t unlike_ = 0;  ///< segments in a row that did not look like that
};

}  // namespace gyrod::core
