/// Filters tuned on the truth, which no user can do: the bar for an estimator that is not.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/evaluation/contender.hpp"
#include "core/evaluation/rivals.hpp"

namespace gyrod::core {

/// A rival at its best.
struct TunedRival {
  std::size_t lag_bound = 0;
  RivalSetting setting;
  double rmse = 0.0;  ///< over the judged samples, in the unit of the record
};

/// What rivals are tuned on.
struct TuningCase {
  std::span<const double> noisy;  ///< finite
  std::span<const double> truth;  ///< as long; NaN: not judged
  SampleRange range;              ///< judged
};

struct TuningOptions {
  /// Points of the logarithmic grid over the parameter, at least 3.
  std::size_t grid_points = 48;
  /// Least cut-off, share and 1/length; cycles per sample.
  double slowest = 2e-4;
  /// Longest moving average and Savitzky-Golay window, samples.
  std::size_t longest_window = 1024;
};

/// The parameter (two for One-Euro) and the delay d, 0 <= d <= bound, any of them, that make
///   RMSE = sqrt(mean_t (y[t + d] - truth[t])^2),   t in range, truth and y known,
/// least, for each of the lag bounds: a logarithmic grid, then golden section between the neighbours of its best point (all integers
/// between them where the parameter counts samples; by steps in both where there are two parameters), and no smoothing at all
/// (pass_through_of()), so that none is worse than raw. A rival that looks at the whole record has d = 0 for every bound. The grid is
/// worked through once for all bounds.
/// @return one for each bound, in their order  @pre noisy.size() == truth.size(), bounds not empty
/// Where no sample can be judged rmse is NaN.
[[nodiscard]] std::vector<TunedRival> tune(Rival rival, const TuningCase& on,
                                           std::span<const std::size_t> lag_bounds,
                                           const TuningOptions& options = {});

/// The tuned rival as a contender; its lag is the delay that was chosen.
[[nodiscard]] Method method_of(const TunedRival& tuned);

/// sqrt(mean (y[t + delay] - truth[t])^2) over t in range where truth[t] is known and y reaches; infinity where that is nowhere.
[[nodiscard]] double delayed_rmse(std::span<const double> y, std::size_t delay, std::span<const double> truth,
                                  SampleRange range) noexcept;

}  // namespace gyrod::core
