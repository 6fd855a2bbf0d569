/// What the axes of a sensor have in common.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/joint_options.hpp"
#include "core/joint/knock_bridge.hpp"
#include "core/joint/noise_shape.hpp"
#include "core/joint/recency_tapers.hpp"
#include "core/signal/cross_power.hpp"

namespace gyrod::core {

/// Each axis of a sensor has noise of its own, while a body that shakes shakes about an axis that is seldom one of the sensor's: all of them see it at
/// once. So in 16 bands of the spectrum each axis is regressed on the two others, sample by sample in phase: what they explain of it is no noise of
/// its own, and what they do not is no less than that.
/// Sizes its workspace once; compare() allocates nothing. One object per worker; not thread-safe.
/// Source: docs/joint.md, "What axes share"; Bendat, Piersol 2010, "Random data", section 7.3 (multiple coherence).
class SharedMotion {
 public:
  /// @param max_samples longest window, as of JointFit, whose tapers these are
  SharedMotion(std::size_t max_samples, const JointOptions& options);

  /// From here on windows are sampled at this rate, Hz; 0 while unknown.
  void set_sample_rate(double sample_rate_hz) noexcept;

  /// @param axes windows of one time, of one length, as JointFit::fit() takes them
  void compare(const std::array<std::span<const double>, kSensorAxes>& axes) noexcept;

  /// How much of the power of each band no other axis shares, in the mean 1 where there is nothing but noise. 1 before compare().
  [[nodiscard]] const BandPower& own(std::size_t axis) const noexcept { return own_[axis]; }

 private:
  void compare(std::size_t band, double values) noexcept;

  JointOptions options_;
  std::size_t max_samples_;
  RecencyTapers tapers_;
  KnockBridge knocks_;
  std::vector<double> centred_;
  std::array<std::vector<std::complex<double>>, kSensorAxes> transforms_;
  std::array<BandPower, kSensorAxes> own_{kAllOwn, kAllOwn, kAllOwn};
};

}  // namespace gyrod::core
