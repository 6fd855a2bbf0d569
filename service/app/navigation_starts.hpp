/// Where in a recording a navigation can start.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "files/navigation_columns.hpp"

namespace gyrod::app {

/// Above what rounding can make of a sum of times, far below a sample.
inline constexpr double kTimeTolerance_s = 1e-9;

struct StartRules {
  double duration_s = 50.0;
  /// Stretch at rest that has to lie before a start; 0: none is needed.
  double level_s = 10.0;
};

/// Tells, for every sample, whether one can start there, and if not, why. One thread at a time; what it is made of
/// has to outlive it.
class StartFinder {
 public:
  enum class Verdict {
    kPossible,
    kTooEarly,   ///< less than level_s after the beginning
    kTooLate,    ///< less than duration_s before the end
    kTruthLost,  ///< the truth does not know the state
    kMoving,     ///< the truth shows motion within level_s before
  };

  /// Horizontal speed of the truth below which a vehicle counts as at rest, m/s: above the noise of satellite
  /// receivers and of differenced positions, below walking.
  static constexpr double kRestSpeed_mps = 0.2;

  /// @param truth nothing: at rest all the time  @param name of the recording, for messages
  StartFinder(std::span<const double> time_s, const std::optional<files::NavigationTruth>& truth,
              const StartRules& rules, std::string name);

  [[nodiscard]] Verdict verdict(std::size_t index) const;

  /// The first sample at or after a time at which the truth is known.
  /// @throws CLI::ValidationError if the time is outside the recording; files::FileError if one cannot start there
  [[nodiscard]] std::size_t at(double time_s) const;

  /// `count` samples, or as many as there are, spread evenly over those where one can start.
  /// @throws files::FileError if there is none, with the reason
  [[nodiscard]] std::vector<std::size_t> spread(std::size_t count) const;

 private:
  [[nodiscard]] std::string reason(Verdict verdict) const;

  std::span<const double> time_s_;
  const std::optional<files::NavigationTruth>& truth_;
  StartRules rules_;
  std::string name_;
  std::vector<double> moving_s_;  ///< times of the truth at which it moves
};

}  // namespace gyrod::app
