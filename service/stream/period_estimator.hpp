/// The sample period of a sensor, from its stamps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gyrod::stream {

/// Median and regularity of the last 64 intervals, looked at every 64 intervals: a function of the stamps
/// alone, so that a replay sees what the vehicle saw. Fixed memory; not thread-safe.
class PeriodEstimator {
 public:
  static constexpr std::size_t kIntervals = 64;
  /// An interval is regular within this part of the median.
  static constexpr double kTolerance = 0.25;
  /// Intervals of the 64 that must be regular for the stamps to be trusted.
  static constexpr std::size_t kRegularIntervals = 58;

  /// @param rate_hz the configured sample rate; 0 if it is to be estimated
  explicit PeriodEstimator(double rate_hz) noexcept;

  /// Takes the interval between two neighbouring samples, ns, positive.
  void add(std::int64_t interval_ns) noexcept;

  /// Sample period in ns, 0 while unknown: the mean of the intervals near the median where the stamps are regular, else of all (a host
  /// that stamps bursts has a median far below the period). A configured rate wins.
  [[nodiscard]] double period_ns() const noexcept { return period_ns_; }

  /// True where stamps alone show that samples are missing.
  [[nodiscard]] bool regular() const noexcept { return regular_ && !catches_up_; }

  /// Sample rate in Hz, 0 while unknown.
  [[nodiscard]] double rate_hz() const noexcept { return period_ns_ > 0.0 ? 1e9 / period_ns_ : 0.0; }

 private:
  void evaluate() noexcept;

  std::array<std::int64_t, kIntervals> intervals_{};
  std::size_t count_ = 0;
  bool configured_;
  double period_ns_;
  bool regular_;
  bool catches_up_ =
      false;  ///< an interval is far too short, which no loss makes: a host stamps late at times
};

}  // namespace gyrod::stream
