/// The strapdown solution over a stretch of a recording.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/inertial/alignment.hpp"
#include "core/inertial/increments.hpp"
#include "core/inertial/strapdown.hpp"

namespace gyrod::core {

/// Samples of a strapdown sensor in body axes; all spans are equally long and finite.
struct InertialSeries {
  std::span<const double> time_s;  ///< rising
  std::array<std::span<const double>, 3> rate_radps;
  std::array<std::span<const double>, 3> specific_force_mps2;
  /// Rates come this many samples after the specific force of the same moment, as a filter that looks ahead
  /// delivers them: sample n uses rate n - delay (the first one before there is any).
  std::size_t rate_delay_samples = 0;

  [[nodiscard]] std::size_t size() const noexcept { return time_s.size(); }
};

/// Sample `index` with the bias taken off.
[[nodiscard]] InertialSample sample_of(const InertialSeries& series, std::size_t index,
                                       const SensorBias& bias) noexcept;

/// Mean rate and specific force of samples [first, end). @pre first < end <= series.size()
[[nodiscard]] InertialSample mean_of(const InertialSeries& series, std::size_t first,
                                     std::size_t end) noexcept;

/// States at the samples first, first + 1, ..., end - 1, the first of them `start`, the others by
/// increment_between() and strapdown_step(). Allocates what it returns.
/// @pre first < end <= series.size()
[[nodiscard]] std::vector<NavigationState> dead_reckoned(const InertialSeries& series, std::size_t first,
                                                         std::size_t end, const NavigationState& start,
                                                         const SensorBias& bias);

}  // namespace gyrod::core
