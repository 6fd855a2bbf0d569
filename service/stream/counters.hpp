/// Counters of the engine: what came in, what went out, what was refused and why.
///
/// Promise 1: for every channel, and for the engine, at every moment
///   received = published + rejected (all reasons) + in_flight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/allan/noise_coefficients.hpp"
#include "stream/health.hpp"
#include "stream/report.hpp"
#include "stream/rest_evidence.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Why a sample was refused. Every refused sample has exactly one reason.
enum class RejectReason : std::uint8_t {
  kNotFinite,        ///< NaN or infinity on an axis
  kOutOfRange,       ///< beyond the configured largest angular rate
  kDuplicate,        ///< a sequence number that was seen already
  kOutOfOrder,       ///< older than the newest accepted sample
  kTimeBackwards,    ///< newer sequence number but the stamp does not advance
  kTooManyChannels,  ///< a new sensor id beyond the channel limit, or beyond the memory there is
  kBadSensorId,      ///< empty, too long, or not printable
  kShuttingDown,     ///< arrived after the stop began
  kHistory,  ///< was published before this start, or before its sensor was out of sight: it fills the window and is not published again
};
inline constexpr std::size_t kRejectReasons = 9;

/// Stable snake_case name, as used in metrics and summaries.
[[nodiscard]] std::string_view name_of(RejectReason reason) noexcept;

/// Counts of one channel, or the sum over all.
struct Counts {
  std::uint64_t received = 0;
  std::uint64_t published = 0;
  std::uint64_t in_flight = 0;  ///< accepted, not released yet; counted on its own, not derived
  std::array<std::uint64_t, kRejectReasons> rejected{};
  std::uint64_t missing = 0;         ///< samples that never arrived, by sequence number or stamp
  std::uint64_t bridged = 0;         ///< positions filled by interpolation inside windows (never published)
  std::uint64_t gaps = 0;            ///< long gaps: the window was closed and a new one opened
  std::uint64_t restarts = 0;        ///< sequence restarts and clock steps: closed and opened anew
  std::uint64_t windows = 0;         ///< windows processed
  std::uint64_t warming_up = 0;      ///< published with kWarmingUp
  std::uint64_t passed_through = 0;  ///< published with kPassThrough
  std::uint64_t hops_widened = 0;    ///< times overload step 1 was entered or deepened
  std::uint64_t overloads = 0;       ///< times overload step 2 (pass-through) was entered
  std::uint64_t realtime = 0;        ///< estimates without look-ahead; stands beside promise 1
  std::uint64_t misfits = 0;         ///< times the model of an axis ceased to explain the input
  std::uint64_t silences = 0;        ///< times nothing came for so long that the window was closed

  [[nodiscard]] std::uint64_t rejected_total() const noexcept;
  Counts& operator+=(const Counts& other) noexcept;
};

/// Histogram with fixed upper bounds in seconds; the last bucket is unbounded. Buckets are not cumulative.
struct TimeHistogram {
  static constexpr std::array<double, 15> kUpperBoundsS = {
      50e-6, 100e-6, 200e-6, 500e-6, 1e-3, 2e-3, 5e-3, 10e-3, 20e-3, 50e-3, 0.1, 0.2, 0.5, 1.0, 5.0};
  std::array<std::uint64_t, kUpperBoundsS.size() + 1> buckets{};
  std::uint64_t count = 0;
  double sum_s = 0.0;

  void add(double seconds) noexcept;
  TimeHistogram& operator+=(const TimeHistogram& other) noexcept;
};

/// What is known of a sensor that may or may not send.
enum class ChannelState : std::uint8_t {
  kActive,          ///< it sends
  kSilent,          ///< it has sent nothing for EngineOptions::silent_after_s
  kDeadlineMissed,  ///< silent, too: it did not send within the time that its writer promised
  kLivelinessLost,  ///< silent, too: its writer gave no sign of life within the time that it promised
  kEnded,           ///< its writer said so, or is gone
};

/// Stable snake_case name.
[[nodiscard]] std::string_view name_of(ChannelState state) noexcept;

[[nodiscard]] constexpr bool is_silent(ChannelState state) noexcept {
  return state != ChannelState::kActive && state != ChannelState::kEnded;
}

/// A channel as monitoring sees it at one moment.
struct ChannelSnapshot {
  std::string sensor;
  Counts counts;
  NoiseReport last_report;  ///< model_epoch 0 until the first window is done
  std::size_t queued_windows = 0;
  std::uint32_t hop_samples = 0;
  double sample_rate_hz = 0.0;
  bool pass_through = false;  ///< overload step 2 in force
  ChannelState state = ChannelState::kActive;
  std::optional<SensorHealth> health = {};  ///< as of the last Engine::judge_health(); none before the first
  /// At rest, since the sensor is known; no terms while nothing is.
  AllanCurves curves{};
  double curves_rate_hz = 0.0;
  std::array<double, kAxes> bias_radps{};  ///< mean rate at rest, learned from bias_s
  double bias_s = 0.0;                     ///< 0: not known
  /// Of the curves, by Engine::fit_curves(): nothing observable before.
  std::array<core::NoiseCoefficients, kAxes> coefficients{};
};

/// The engine as monitoring sees it at one moment. Counts obey promise 1 even while samples flow.
struct EngineSnapshot {
  Counts totals;  ///< includes samples that belong to no channel: refused ids, forgotten channels
  std::size_t channels = 0;
  std::size_t silent_channels = 0;       ///< of the three states that are silent
  std::uint64_t forgotten_channels = 0;  ///< closed for good; their counts stay in `totals`
  std::size_t queued_windows = 0;        ///< over all channels
  HealthCounts channels_by_health{};     ///< of those that were judged
  HealthCounts health_changes{};  ///< times that a sensor was found in a state, newly or with other axes
  /// The worst of all sensors, as of the last Engine::judge_health(): 0 none, 1 hop widened, 2 passed through.
  unsigned overload_step = 0;
  std::size_t workers = 0;
  std::size_t workers_busy = 0;
  TimeHistogram window_time;    ///< time a worker spent on one window of a sensor
  TimeHistogram added_latency;  ///< from the arrival of the sample that completed a hop to the hop's release
};

}  // namespace gyrod::stream
