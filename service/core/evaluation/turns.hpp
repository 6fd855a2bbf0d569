/// How quickly an estimator takes a turn after a long straight.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/evaluation/contender.hpp"

namespace gyrod::core {

/// Straight ahead, then a rate that rises along a straight line and stays. Unit: deg/s.
struct TurnProfile {
  std::string_view name;
  double rate_dps;
  double rise_s;  ///< 0: from one sample to the next
};

inline constexpr std::array<TurnProfile, 3> kTurnProfiles = {{
    {"10 deg/s within 0.3 s", 10.0, 0.3},
    {"2 deg/s within 0.3 s", 2.0, 0.3},
    {"20 deg/s^2 for 1 s", 20.0, 1.0},
}};

struct TurnOptions {
  double rate_hz = 100.0;
  double straight_s = 60.0;
  double hold_s = 5.0;
  /// Runs with other stretches of the noise, over which the response is averaged; at least 1.
  std::size_t repeats = 3;
};

/// What came of a turn. Times in seconds; nothing where the level is never reached.
struct TurnResponse {
  std::optional<double> half_delay_s;  ///< mean response at half the final rate, later than the truth
  std::optional<double>
      time_95_s;           ///< from the turn's start until the mean response first has 95 % of the final rate
  double overshoot = 0.0;  ///< greatest mean response / final rate - 1, at least 0
  double peak_error_dps =
      0.0;  ///< greatest |error| from 0.5 s before the turn to 2 s after its rise, mean over the repeats
  /// For drawing: the mean response from 1 s before the turn to 3 s after its start, at every sample, beside the truth.
  double trace_start_s = 0.0;  ///< against the turn's start
  std::vector<double> trace_dps;
  std::vector<double> trace_truth_dps;
};

/// The true rate of a whole run.
[[nodiscard]] std::vector<double> turn_truth(const TurnProfile& profile, const TurnOptions& options);

/// Runs the method `repeats` times on the turn plus stretches of the noise, spread evenly over it; noise that is too short is repeated.
/// @param noise_dps finite; empty: none
[[nodiscard]] TurnResponse turn_response(const Method& method, const TurnProfile& profile,
                                         std::span<const double> noise_dps, const TurnOptions& options);

}  // namespace gyrod::core
