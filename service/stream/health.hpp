/// What state a sensor is in, as people who look after a fleet see it: one word, worst first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "stream/sample.hpp"

namespace gyrod::stream {

/// Best first: of several that hold, the last is the state. The numbers are those of idl/gyrod.idl and of the metrics.
enum class Health : std::uint8_t {
  kOk = 0,
  kWarmingUp = 1,  ///< the window is not full
  kDegraded = 2,   ///< gyrod is overloaded: hop widened, or samples pass through
  kLossy = 3,      ///< samples are missing or refused
  kDrifting = 4,   ///< the bias at rest has moved by more than its own Allan deviation explains
  kNoisy = 5,      ///< the noise at rest is well above what it was
  kSaturated = 6,  ///< the converter's range is too small for the motion
  kStuck = 7,      ///< the same value again and again
  kSilent = 8,     ///< no samples
};
inline constexpr std::size_t kHealthStates = 9;

/// Stable snake_case name, as used in metrics and logs.
[[nodiscard]] std::string_view name_of(Health health) noexcept;

/// When a state is entered and left. Seconds are of the samples' stamps, but for silent and lossy: of the engine's clock.
struct HealthOptions {
  /// Silent: nothing for so long, s, and for ten sample periods; 0.01..86400.
  double silent_after_s = 1.0;
  /// Stuck: one value for so long, s, while another axis changes; 0.01..86400.
  double stuck_after_s = 1.0;
  /// Stuck: one value on all axes for so long, s; stuck_after_s..86400.
  double all_stuck_after_s = 10.0;
  /// Saturated: three samples in a window at this rate, rad/s, on an axis. 0: at the limit that the sensor itself shows.
  double range_radps = 0.0;
  /// Saturated no longer: so long, s, without; 0..86400.
  double saturated_hold_s = 10.0;
  /// Noisy: standard deviation at rest over the calibrated or learned one; above 1.
  double noisy_ratio = 1.5;
  /// Noisy no longer: below this; 1..noisy_ratio.
  double noisy_clear_ratio = 1.3;
  /// Noisy: for so long at rest without a break, s; 0..86400.
  double noisy_after_s = 60.0;
  /// Drifting: bias against the learned one, in standard deviations that the Allan deviation foretells; above 0.
  double drift_sigmas = 5.0;
  /// Lossy: share of samples missing or refused within loss_window_s; above 0, at most 1.
  double lossy_share = 0.01;
  /// Lossy no longer: below this; 0..lossy_share.
  double lossy_clear_share = 0.005;
  /// s; 1..3600.
  double loss_window_s = 60.0;
};

/// The state of one axis and what speaks for it: `value` against `limit`, in the unit that the state has.
///   silent: s since the last sample; stuck: s of one value; saturated: s since the last triple, against the hold;
///   noisy: ratio of deviations; drifting: rad/s; lossy: share; degraded: overload step against 1; warming_up: samples of the
///   window; ok: 0 and 0.
struct AxisHealth {
  Health state = Health::kWarmingUp;
  double value = 0.0;
  double limit = 0.0;
};

/// Of a sensor: the worst of its axes.
struct SensorHealth {
  Health state = Health::kWarmingUp;
  std::array<AxisHealth, kAxes> axis{};
};

/// Counts channels, or events, by state.
using HealthCounts = std::array<std::uint64_t, kHealthStates>;

}  // namespace gyrod::stream
