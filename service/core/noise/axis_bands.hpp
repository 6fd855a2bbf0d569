/// The spectra of a sensor's three axes in bands: whether they are those of noise behind one low-pass.
#pragma once

#include <array>
#include <cstddef>

#include "core/noise/noise_fit.hpp"
#include "core/signal/cross_power.hpp"

namespace gyrod::core {

/// Segments overlap by half.
inline constexpr std::size_t kSegmentHop = kNoiseSegment / 2;

/// Segments of each half of what is judged: four, and four seconds of them at least. @pre sample_rate_hz > 0
[[nodiscard]] double segments_of_half(double sample_rate_hz) noexcept;

/// Bands a quarter wide, of spectra of half overlapping segments of kNoiseSegment samples, from kFirstNoiseBin on. All questions may be asked of the bands from
/// some `first` one on: below it there is motion.
/// A plain value; allocates nothing.
class AxisBands {
 public:
  static constexpr std::size_t kMost = 24;
  /// Density in each band.
  using Bands = std::array<double, kMost>;
  using Axes = std::array<Bands, kSensorAxes>;

  /// Of the axes that are alive, the first `alive` of `axes`, each to the scale of the middle one.
  struct Likeness {
    Axes axes{};
    Bands middle{};
    std::size_t alive = 0;
    std::size_t first = 0;  ///< of the bands that were compared
    double count = 0.0;     ///< segments
    double spectra = 0.0;   ///< that the middle one is as good as the mean of
  };

  AxisBands() noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// First bin of a band; of size(): one past the last.
  [[nodiscard]] std::size_t edge(std::size_t band) const noexcept { return edges_[band]; }
  [[nodiscard]] double bins(std::size_t band) const noexcept {
    return static_cast<double>(edges_[band + 1] - edges_[band]);
  }
  /// Adds the mean densities of a spectrum to sums of them.
  void add(const NoiseSpectrum& power, Bands& sums) const noexcept;
  /// Over the bands from `first` to before `end`; 0 of none.
  [[nodiscard]] double mean_density(const Bands& bands, std::size_t first, std::size_t end) const noexcept;
  /// Ratio by which the band's mean over so many spectra may be off by chance.
  [[nodiscard]] double chance(std::size_t band, double spectra) const noexcept;

  /// @param sums of densities over `count` segments
  [[nodiscard]] Likeness compare(const Axes& sums, double count, std::size_t first = 0) const noexcept;
  /// Equivalent statistical bandwidth in parts of half the rate, (sum of S)^2 / (sum of S^2) over the bins, as if all before `first` had this density.
  /// @pre the first `first` bands of the middle one count for nothing
  [[nodiscard]] double bandwidth(const Likeness& likeness, double density) const noexcept;
  /// One past the last of the bands from the first on that are alike; 0 where one of them rises.
  [[nodiscard]] std::size_t flat_end(const Likeness& likeness) const noexcept;
  /// Whether no band after these rises by more than chance, and the last has less than a tenth of them. @pre flat_end > first
  [[nodiscard]] bool falls(const Likeness& likeness, std::size_t flat_end) const noexcept;
  /// Whether the last band has less than a tenth of this density.
  [[nodiscard]] bool ends_low(const Likeness& likeness, double flat_density) const noexcept;
  /// Whether each axis is that of the middle one, but for a line of its own in two bands, where there is a tenth of this density.
  [[nodiscard]] bool alike(const Likeness& likeness, double flat_density) const noexcept;
  /// Whether a band has that, and tells something.
  [[nodiscard]] static bool tells(const Likeness& likeness, std::size_t band, double flat_density) noexcept;

 private:
  void find_middle(Likeness& likeness) const noexcept;
  void scale_to_middle(Bands& axis, const Likeness& likeness) const noexcept;

  std::array<std::size_t, kMost + 1> edges_{};
  std::size_t size_ = 0;
};

}  // namespace gyrod::core
