/// The two-speed estimator on a record in memory.
#pragma once

#include <cstddef>
#include <span>

#include "app/noise_course.hpp"
#include "core/evaluation/contender.hpp"
#include "core/joint/joint_options.hpp"

namespace gyrod::app {

/// How the estimator is run.
struct JointRun {
  double sample_rate_hz = 0.0;  ///< 0 where unknown
  std::size_t window_samples = 1024;
  unsigned doublings = 0;        ///< of the window, as stream::doublings_at() has them
  std::size_t lag_samples = 16;  ///< at most core::kMaxLag
  bool realtime = false;         ///< the answers at once, instead of those with the lag
  /// The sensor's, in the record's unit; nothing, or a model that is not usable: the windows' own guess.
  NoiseCourse noise;
  core::JointOptions options;  ///< the hop among them
  double max_signal_hz = 0.0;  ///< what is faster counts as noise; 0: nothing does
};

/// The model of the window that ends at sample n * hop is used from sample (n + 1) * hop on, as the stream does (stream::HopSchedule); windows at
/// the beginning hold what there is.
[[nodiscard]] core::Contender joint_contender(const JointRun& run, std::span<const double> noisy);

}  // namespace gyrod::app
