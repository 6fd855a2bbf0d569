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
  double after_s = 6.0;  ///< how long a run goes on after the turn's start
  /// Runs with other stretches of the noise, over which the response is averaged; at least 1.
  std::size_t repeats = 3;
};

/// What came of a turn. Times in seconds; nothing where the level is never reached. The response is what the turn changes: the answer to the
/// turn in noise, less the answer to the same noise without it.
struct TurnResponse {
  std::optional<double> half_delay_s;  ///< mean response at half the final rate, later than the truth
  /// Its standard error, by how the runs differ there; nothing with fewer than two.
  std::optional<double> half_delay_error_s;
  /// From the turn's start until the mean response first has 95 % of the final rate.
  std::optional<double> time_95_s;
  double overshoot = 0.0;  ///< greatest mean response / final rate - 1, at least 0
  /// Greatest |answer - truth|, noise and all, from 0.5 s before the turn to 2 s after its rise, mean over the repeats.
  double peak_error_dps = 0.0;
  /// For drawing: the mean response from 1 s before the turn to 3 s after its start, at every sample, beside the truth.
  double trace_start_s = 0.0;  ///< against the turn's start
  std::vector<double> trace_dps;
  std::vector<double> trace_truth_dps;
};

/// The true rate of a whole run.
[[nodiscard]] std::vector<double> turn_truth(const TurnProfile& profile, const TurnOptions& options);

/// A method's turns in noise. What it answers to the noise alone is known once and for all of them.
class TurnTrials {
 public:
  /// Runs the method `repeats` times on stretches of the noise, spread evenly over it; noise that is too short is repeated.
  /// @param noise_dps finite; empty: none
  TurnTrials(Method method, std::span<const double> noise_dps, const TurnOptions& options);

  /// Runs it as often on the turn plus the same stretches. @pre the turn has ended when a run does
  [[nodiscard]] TurnResponse take(const TurnProfile& profile) const;

 private:
  [[nodiscard]] std::vector<double> noise(std::size_t repeat) const;

  Method method_;
  std::vector<double> noise_dps_;
  TurnOptions options_;
  std::vector<std::vector<double>> straights_;  ///< what it answers to the noise
};

}  // namespace gyrod::core
