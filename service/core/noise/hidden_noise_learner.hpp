/// Learns while a sensor moves what does not show at a glance of its noise: what its own low-pass has shaped, and its lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/noise/axis_bands.hpp"
#include "core/noise/axis_spectra.hpp"
#include "core/noise/noise_alone.hpp"
#include "core/noise/noise_fit.hpp"
#include "core/noise/noise_model.hpp"
#include "core/noise/own_lines.hpp"
#include "core/noise/rest_detector.hpp"
#include "core/signal/periodogram.hpp"

namespace gyrod::core {

/// Averages the spectra of what find_noise_alone() finds in two halves of four segments and four seconds at least, flat up to 10 Hz or more, each
/// band with the weight of ten minutes at most. What is 1.5 times as loud as what has been learned is left out; where it is as much quieter, learning
/// begins anew, as motion only adds; and so it does where half an hour of it was louder. From four halves on, and again whenever a tenth has been added,
/// fit_noise_and_lines() makes models of
///   the shape:  band by band that of the quietest axis, and of those that are louder by chance, each to the scale of the others, as a low-pass is one for
///            all of them; before the slowest band that was learned as dense as those after it that are alike. An axis's own lines are not part of it;
///   the scale:  of each axis where the low-pass falls off, as motion is slower than that.
/// Lines are those of OwnLines, which takes all segments: with these models, and alone where there are none.
/// A function of samples and sample rate alone. About 140 kB; nothing allocates after construction. One thread at a time.
/// Source: docs/joint.md, "Noise that a low-pass hides".
class HiddenNoiseLearner {
 public:
  /// @pre sample_rate_hz > 0
  explicit HiddenNoiseLearner(double sample_rate_hz);

  /// One sample, finite. Costs 0.4 us: three transforms every 256 samples, their products and logarithms; and 0.3 ms where models are made.
  /// @param rate rad/s
  /// @param measured false where it lies on the line between its neighbours: more than two such in a hundred, or of an axis that hangs, and a
  /// segment tells nothing
  void step(const Triple& rate, bool measured = true) noexcept;
  /// A gap in the samples. What is learned stays.
  void interrupt() noexcept;
  /// The sample rate turns out to be another: forgets all. Allocates nothing. @pre sample_rate_hz > 0
  void retime(double sample_rate_hz) noexcept;

  /// Rises with every change of models().
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// As measured, without kNoiseMargin. Not usable (is_usable()) before enough was learned, but for lines that are known.
  [[nodiscard]] const std::array<NoiseModel, kSensorAxes>& models() const noexcept { return models_; }

 private:
  using Spectra = std::array<NoiseSpectrum, kSensorAxes>;

  struct Half {
    Spectra power{};  ///< sums over the segments
    AxisDensities bands;
  };

  void end_segment() noexcept;
  void add_segment() noexcept;
  void end_half() noexcept;
  void watch_least() noexcept;
  [[nodiscard]] AxisBands::Axes least() const noexcept;
  [[nodiscard]] AxisBands::Axes held() const noexcept;
  [[nodiscard]] bool believes(const NoiseAlone& found) noexcept;
  [[nodiscard]] bool has_enough() const noexcept { return weight_[bands_.size() - 1] >= least_segments_; }
  void learn(const Half& half, std::size_t first) noexcept;
  void fit() noexcept;
  [[nodiscard]] Triple scales(std::size_t first) const noexcept;
  [[nodiscard]] NoiseSpectrum quietest_shape(std::size_t first, const Triple& scale) const noexcept;
  void forget() noexcept;
  void publish() noexcept;

  double half_seconds_ = 0.0;
  double half_segments_ = 0.0;
  double least_segments_ = 0.0;  ///< to learn from
  double motion_bins_ = 0.0;
  double most_segments_ = 0.0;
  AxisBands bands_;
  Periodogram periodogram_;
  std::array<std::vector<double>, kSensorAxes> segment_;
  AxisTransforms transforms_{};
  std::size_t in_segment_ = 0;
  std::array<std::size_t, 2> unmeasured_{};  ///< samples of the segment's halves
  Triple last_{};
  std::array<std::size_t, kSensorAxes> repeats_{};  ///< of the last sample
  Half this_half_;
  Half last_half_;
  bool last_counted_ = false;  ///< the last half has been learned from
  AxisBands::Axes least_{};    ///< density that each band has had in both halves, of late
  AxisBands::Axes least_before_{};
  double least_seconds_ = 0.0;  ///< of least_
  Spectra power_{};             ///< averages over weight_
  AxisBands::Bands weight_{};   ///< segments; never less in a faster band
  double since_fit_ = 0.0;      ///< of these, of the fastest
  double louder_seconds_ = 0.0;
  std::array<NoiseModel, kSensorAxes> fitted_{};  ///< without the axes' own lines
  OwnLines own_lines_;
  std::array<NoiseModel, kSensorAxes> models_{};
  std::uint64_t revision_ = 0;
};

}  // namespace gyrod::core
