/// From evidence to a state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "stream/health.hpp"
#include "stream/health_watch.hpp"

namespace gyrod::stream {

/// What else counts, of gyrod itself.
struct HealthContext {
  double now_s = 0.0;  ///< of the engine's clock; rises
  /// Until then gyrod itself did not listen: a silence is counted from there at the earliest.
  double deaf_until_s = 0.0;
  unsigned overload_step = 0;  ///< 0 none, 1 hop widened, 2 passed through
};

/// Judges one sensor, asked about once a second. A function of the calls. Allocates nothing. One thread at a time.
class HealthJudge {
 public:
  HealthJudge(const HealthOptions& options, std::size_t window_samples) noexcept;

  [[nodiscard]] SensorHealth judge(const HealthEvidence& evidence, const HealthContext& context) noexcept;

 private:
  /// Samples by then.
  struct Sum {
    double time_s = 0.0;
    std::uint64_t accepted = 0;
    std::uint64_t lost = 0;
  };
  static constexpr std::size_t kParts = 60;  ///< of the loss window

  [[nodiscard]] AxisHealth judge_sensor(const HealthEvidence& evidence,
                                        const HealthContext& context) noexcept;
  [[nodiscard]] AxisHealth judge_axis(const HealthEvidence& evidence, std::size_t axis) const noexcept;
  [[nodiscard]] bool is_stuck(const HealthEvidence& evidence, std::size_t axis) const noexcept;
  void watch_loss(const HealthEvidence& evidence, double now_s) noexcept;

  HealthOptions options_;
  std::uint64_t window_samples_;
  std::array<Sum, kParts + 1> sums_{};  ///< ring, oldest at first_
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  double share_ = 0.0;
  bool lossy_ = false;
};

}  // namespace gyrod::stream
