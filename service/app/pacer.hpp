/// Sends samples at the pace of their stamps.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "app/interrupt.hpp"

namespace gyrod::app {

/// One thread.
class Pacer {
 public:
  /// A longer pause between two samples is cut to this, so that a jump of the clock in a recording does not
  /// stop its replay.
  static constexpr std::chrono::seconds kLongestPause{10};

  /// @param speed times real time; 0 never waits
  Pacer(double speed, Interrupt& interrupt) noexcept : speed_(speed), interrupt_(interrupt) {}

  /// Waits until a sample with this stamp is due. @return false if that was interrupted
  [[nodiscard]] bool wait_until_due(std::int64_t stamp_ns) noexcept;

 private:
  using Clock = std::chrono::steady_clock;

  double speed_;
  Interrupt& interrupt_;
  std::optional<std::int64_t> origin_ns_;  ///< stamp that was due at `begin_`
  Clock::time_point begin_{};
};

}  // namespace gyrod::app
