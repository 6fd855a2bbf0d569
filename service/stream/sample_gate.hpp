/// The gate of a channel: which samples are taken, which are refused and why, and where something is missing.
#pragma once

#include <cstdint>
#include <optional>

#include "stream/counters.hpp"
#include "stream/period_estimator.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

struct GateOptions {
  double sample_rate_hz = 0.0;             ///< see EngineOptions
  double max_rate_radps = 175.0;           ///< see EngineOptions
  std::uint64_t max_bridged_samples = 16;  ///< see EngineOptions
};

/// What the gate decides about one sample.
struct Verdict {
  enum class Kind : std::uint8_t {
    kAccept,   ///< next sample of the window, after `bridge` positions to fill
    kRefuse,   ///< not taken, for `reason`
    kGap,      ///< taken, after a gap too long to bridge: a new window begins
    kRestart,  ///< taken, the sensor's sequence or clock began anew: a new window begins
  };
  Kind kind = Kind::kAccept;
  RejectReason reason = RejectReason::kNotFinite;  ///< kRefuse only
  std::uint64_t bridge = 0;   ///< kAccept only: positions to fill, refused samples among them
  std::uint64_t missing = 0;  ///< samples that never arrived
};

/// Judges the samples of one sensor, one after the other. A pure function of what it was shown: no clock,
/// fixed memory.
///
/// Missing samples show in the sequence number; where the stamps are regular, a step in time shows them too
/// (recordings have rows cut out). A sample that looks old is refused, but when kAnew samples in a row agree
/// with one another that the sequence or the clock began anew, the last of them is taken: a reboot or a clock
/// step must not silence a sensor for good.
class SampleGate {
 public:
  static constexpr int kAnew = 8;
  /// A pause longer than this closes the window even where the stamps are too irregular to count missing
  /// samples.
  static constexpr std::int64_t kLongestPauseNs = 1'000'000'000;
  /// A sensor that leaves out no number and steps further ahead in time than this has not lost samples: its clock was set.
  static constexpr std::int64_t kClockSetNs = 60'000'000'000;
  /// A sequence step beyond this is not a loss but another numbering, as many periods in time another clock.
  static constexpr std::uint64_t kLargestLoss = 1ULL << 31U;

  explicit SampleGate(const GateOptions& options) noexcept;

  [[nodiscard]] Verdict judge(const Sample& sample) noexcept;

  /// Nothing has come for long: a sample that is older by far, 64 numbers or kLongestPauseNs, is then taken for a new beginning at once,
  /// and not after kAnew of them. Until the next sample that is taken.
  void expect_restart() noexcept { restart_expected_ = true; }

  /// The sensor has ended: the next sample is taken, whatever its number and stamp, and begins a new window. Where both go on as if it had
  /// sent all the time, what lies between is missing; the period is kept.
  void reopen() noexcept;
  /// As reopen(), and what lies between is not missing: others have taken it.
  void forget() noexcept;

  /// True once a sample was accepted since the beginning or since reopen().
  [[nodiscard]] bool is_open() const noexcept { return open_; }
  /// Sample rate in Hz, 0 while unknown.
  [[nodiscard]] double rate_hz() const noexcept { return period_.rate_hz(); }

 private:
  [[nodiscard]] std::optional<RejectReason> unfit(const Sample& sample) const noexcept;
  [[nodiscard]] std::optional<RejectReason> stale(const Sample& sample) const noexcept;
  [[nodiscard]] std::uint64_t missing_since_end(const Sample& sample) const noexcept;
  [[nodiscard]] bool older_by_far(const Sample& sample) const noexcept;
  [[nodiscard]] bool begins_anew(const Sample& sample) noexcept;
  [[nodiscard]] double periods_in(std::int64_t interval_ns) const noexcept;
  [[nodiscard]] std::uint64_t missing_by_stamp(std::int64_t interval_ns) const noexcept;
  [[nodiscard]] Verdict advance(const Sample& sample) noexcept;
  void remember(const Sample& sample) noexcept;

  GateOptions options_;
  PeriodEstimator period_;
  bool open_ = false;
  bool ever_open_ = false;
  std::uint64_t last_sequence_ = 0;
  std::int64_t last_stamp_ns_ = 0;
  std::uint64_t seen_ = 0;  ///< bit i: sequence number last_sequence_ - i has arrived
  std::uint64_t refused_ahead_ =
      0;              ///< unfit samples newer than the last accepted one: arrived, so not missing
  Sample suspect_{};  ///< last stale sample
  bool restart_expected_ = false;
  int suspects_ = 0;  ///< stale samples in a row that agree with one another
};

}  // namespace gyrod::stream
