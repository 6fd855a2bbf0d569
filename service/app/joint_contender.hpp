/// The two-speed estimator on a record in memory.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/noise_course.hpp"
#include "core/evaluation/contender.hpp"
#include "core/joint/joint_options.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// How the estimator is run.
struct JointRun {
  double sample_rate_hz = 0.0;  ///< 0 where unknown
  std::size_t window_samples = 1024;
  unsigned doublings = 0;        ///< of the window, as stream::doublings_at() has them
  std::size_t lag_samples = 16;  ///< at most core::kMaxLag
  bool realtime = false;         ///< the answers at once, instead of those with the lag
  /// Of x, y, z, in the record's unit; nothing, or a model that is not usable: the windows' own guess.
  std::array<NoiseCourse, stream::kAxes> noise;
  core::JointOptions options;  ///< the hop among them
  double max_signal_hz = 0.0;  ///< what is faster counts as noise; 0: nothing does
};

/// What the daemon makes of one axis of a sensor. The model of the window that ends at sample n * hop is used from sample (n + 1) * hop on, as the
/// stream does (stream::HopSchedule); windows at the beginning hold what there is. The other axes take part for as long as the axis's noise is not
/// known by level and colour (stream::ModelMethod::compare()).
/// @param noisy x, y, z: that of `axis`, and each other as long as that, or empty: not measured
[[nodiscard]] core::Contender joint_contender(
    const JointRun& run, std::size_t axis, const std::array<std::span<const double>, stream::kAxes>& noisy);

}  // namespace gyrod::app
