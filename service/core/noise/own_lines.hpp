/// Finds the lines of a sensor's own noise while it moves.
#pragma once

#include <array>
#include <cstddef>

#include "core/noise/axis_spectra.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Averages the spectra of segments, of the last ten minutes at most, and takes for the sensor's own a line that in two blocks in a row, of eight and of 15 s at
/// least, is
///   alone:   no other axis shares it (AxisSpectra::shared()): what shakes a sensor shakes its axes together;
///   random:  its phase in a segment says little of that in the next but one, which does not overlap: they correlate by less than a half. That of a sine, however
///            strong at the time, goes on as it was;
///   lasting: ln of its power is in the mean no more than 1.2 below ln of the mean: 0.58 of noise, 2 of what knocks make ring now and then;
///   steady:  as strong in the block as in all, within a factor of two.
/// A plain value of about 70 kB; allocates nothing.
/// Source: docs/noise.md, "In motion".
class OwnLines {
 public:
  /// @param segment_seconds between the beginnings of two segments, above 0
  explicit OwnLines(double segment_seconds) noexcept { retime(segment_seconds); }

  /// @param segment of the stretch that half overlaps the last one's
  /// @param sums    of that segment alone; where it is not finite nothing is added
  /// @return whether lines() has changed
  bool add(const AxisTransforms& segment, const AxisSums& sums) noexcept;
  /// The next segment does not go on where the last one was.
  void interrupt() noexcept { since_gap_ = 0; }
  /// Forgets all.
  void retime(double segment_seconds) noexcept;

  /// Models of lines alone: not usable (is_usable()), as nothing is known of the rest.
  [[nodiscard]] const std::array<NoiseModel, kSensorAxes>& lines() const noexcept { return lines_; }

 private:
  using Axes = std::array<NoiseSpectrum, kSensorAxes>;

  void follow_phase(const AxisTransforms& segment) noexcept;
  bool end_block() noexcept;
  [[nodiscard]] NoiseModel candidates(std::size_t axis) const noexcept;
  [[nodiscard]] bool is_own(std::size_t axis, const SpectralLine& line,
                            const NoiseSpectrum& floor) const noexcept;

  double block_segments_ = 0.0;
  double most_segments_ = 0.0;
  AxisSpectra all_;
  Axes log_{};  ///< means of ln of the power, as all_ has those of the power
  /// Means of the segment times the conjugate of the last but one.
  AxisTransforms later_{};
  double later_segments_ = 0.0;
  std::array<AxisTransforms, 2> last_{};  ///< the last segment, and the one before
  std::size_t since_gap_ = 0;             ///< segments
  Axes block_{};                          ///< sums over the block at work
  double in_block_ = 0.0;
  std::array<NoiseModel, kSensorAxes> candidates_{};  ///< of the last block
  std::array<NoiseModel, kSensorAxes> lines_{};
};

}  // namespace gyrod::core
