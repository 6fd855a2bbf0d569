/// Tells noise that a sensor's own low-pass filter has shaped from motion, by the spectra of its three axes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/noise/noise_fit.hpp"
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
/// Bands are a quarter wide, of spectra of half overlapping segments of kNoiseSegment samples: the last five to eight, and four to eight
/// seconds of them at least. What they say is kept for four segments that say nothing.
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
  static constexpr std::size_t kMostBands = 24;
  using Bands = std::array<double, kMostBands>;
  using Axes = std::array<Bands, 3>;

  struct Shape {
    double independent = 1.0;
    double slow = 1.0;
  };
  /// Sums over so many segments, of mean densities in the bands.
  struct Spectra {
    Axes axes{};
    double count = 0.0;
  };
  /// Of the axes that are alive, the first `alive` of `axes`, each to the scale of the middle one.
  struct Likeness {
    Axes axes{};
    Bands middle{};
    std::size_t alive = 0;
    double count = 0.0;    ///< segments
    double spectra = 0.0;  ///< that the middle one is as good as the mean of
  };

  void end_segment(Periodogram& periodogram) noexcept;
  void judge() noexcept;
  [[nodiscard]] Likeness compare() const noexcept;
  void find_middle(Likeness& likeness) const noexcept;
  void scale_to_middle(Bands& axis, const Bands& middle) const noexcept;
  [[nodiscard]] Shape shape_of(const Bands& middle) const noexcept;
  [[nodiscard]] std::size_t flat_bands(const Likeness& likeness) const noexcept;
  [[nodiscard]] bool falls(const Likeness& likeness, std::size_t flat) const noexcept;
  [[nodiscard]] bool alike(const Likeness& likeness, double flat_density) const noexcept;
  [[nodiscard]] double bins(std::size_t band) const noexcept {
    return static_cast<double>(edges_[band + 1] - edges_[band]);
  }
  [[nodiscard]] double mean_density(const Bands& bands, std::size_t count) const noexcept;
  [[nodiscard]] double chance(std::size_t band, double spectra) const noexcept;

  std::array<std::size_t, kMostBands + 1> edges_{};
  std::size_t bands_ = 0;
  std::array<std::vector<double>, 3> segment_;
  std::size_t in_segment_ = 0;
  double enough_ = 0.0;  ///< segments of a half
  Spectra this_half_;
  Spectra last_half_;
  Shape shape_;
  std::size_t unlike_ = 0;  ///< segments in a row that did not look like that
};

}  // namespace gyrod::core
