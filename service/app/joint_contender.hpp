/// The two-speed estimator on a record in memory.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "app/noise_course.hpp"
#include "core/evaluation/contender.hpp"
#include "core/joint/joint_options.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// How the estimator is run.
struct JointRun {
  double sample_rate_hz = 0.0;  ///< 0 where unknown
  std::size_t window_samples = 1024;
  unsigned doublings = 0;  ///< of the window, as stream::doublings_at() has them
  /// Of x, y, z, in the record's unit; nothing, or a model that is not usable: the windows' own guess.
  std::array<NoiseCourse, stream::kAxes> noise;
  core::JointOptions options;  ///< the hop among them
  double max_signal_hz = 0.0;  ///< what is faster counts as noise; 0: nothing does
};

/// What is asked of it.
struct JointAnswer {
  std::size_t lag_samples = 16;  ///< of its filter, at most core::kMaxLag
  bool realtime = false;         ///< what that answers at once, instead of what it answers with the lag

  friend bool operator==(const JointAnswer&, const JointAnswer&) = default;
};

/// What the daemon makes of one axis of a sensor. The model of the window that ends at sample n * hop is used from sample (n + 1) * hop on, as the
/// stream does (stream::HopSchedule); windows at the beginning hold what there is. The other axes take part for as long as the axis's noise is not
/// known by level and colour (stream::ModelMethod::compare()). Models take nearly all of the time, and are made once for all answers.
/// @param noisy x, y, z: that of `axis`, and each other as long as that, or empty: not measured
/// @return one for each of `answers`, in their order
[[nodiscard]] std::vector<core::Contender> joint_contenders(
    const JointRun& run, std::span<const JointAnswer> answers, std::size_t axis,
    const std::array<std::span<const double>, stream::kAxes>& noisy);

}  // namespace gyrod::app
