/// Averaged spectra of a sensor's three axes, and of what they have in common.
#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "core/noise/noise_fit.hpp"
#include "core/signal/cross_power.hpp"

namespace gyrod::core {

/// A segment's transform, or a product of two, bins 0..N/2 of N = kNoiseSegment samples.
using NoiseTransform = std::array<std::complex<double>, kNoiseBins>;
using AxisTransforms = std::array<NoiseTransform, kSensorAxes>;

/// The axis after this one, and the one after that.
constexpr std::size_t next_axis(std::size_t axis) noexcept { return (axis + 1) % kSensorAxes; }
constexpr std::size_t last_axis(std::size_t axis) noexcept { return (axis + 2) % kSensorAxes; }

/// Sums over segments, unit^2 per sample. A plain value; allocates nothing.
struct AxisSums {
  std::array<NoiseSpectrum, kSensorAxes> power{};
  /// [i]: X_j times the conjugate of X_k, j = next_axis(i), k = last_axis(i).
  AxisTransforms cross{};
  double count = 0.0;

  void add(const AxisTransforms& segment) noexcept;
};

/// Averages of segments, older ones faded. An axis, or a pair, may have come to life later than others.
struct AxisSpectra {
  std::array<NoiseSpectrum, kSensorAxes> power{};
  AxisTransforms cross{};                            ///< as AxisSums has it
  std::array<double, kSensorAxes> segments{};        ///< that power weighs
  std::array<double, kSensorAxes> cross_segments{};  ///< that cross weighs

  /// @param alive axes that are taken
  /// @param most that an average may weigh, above sums.count
  void blend(const AxisSums& sums, const std::array<bool, kSensorAxes>& alive, double most) noexcept;

  /// What of the power in these bins of an axis it has in common with the axis that it has most in common with: coherence, 0..1, with the weight of both
  /// powers; as far as that is more than independent axes have by chance in one of a hundred, and 0 where it is not.
  [[nodiscard]] double shared(std::size_t axis, std::size_t first, std::size_t last) const noexcept;
  /// The same, but of no axis that is a copy of this one: where coherence is above 0.9 in the mean of all bins, as on a bench that adds one noise to all axes, it
  /// says nothing of a line.
  [[nodiscard]] double shared_apart(std::size_t axis, std::size_t first, std::size_t last) const noexcept;

 private:
  [[nodiscard]] double shared_with(std::size_t axis, std::size_t other, std::size_t first,
                                   std::size_t last) const noexcept;
  [[nodiscard]] bool are_copies(std::size_t axis, std::size_t other) const noexcept;
};

}  // namespace gyrod::core
