/// What the intake sees of a sensor's health, sample by sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "stream/health.hpp"
#include "stream/rest_evidence.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// What speaks for or against the health of one axis.
struct AxisEvidence {
  double same_s = 0.0;  ///< the newest value has been the same for so long
  double since_saturated_s =
      -1;  ///< since the newest of three samples at the limit in one window; negative: never
  bool noisy = false;
  double noise_ratio = 0.0;  ///< at the last rest; 0 while nothing is known
  bool drifting = false;
  double bias_offset_radps = 0.0;  ///< at the last rest
  double bias_limit_radps = 0.0;   ///< 0 while nothing is known
};

/// What speaks for or against the health of one sensor. Plain values: the intake makes them, HealthJudge reads a copy.
struct HealthEvidence {
  double heard_s = 0.0;         ///< engine time of the newest samples
  bool ended = false;           ///< the writer has gone
  double sample_rate_hz = 0.0;  ///< 0 while unknown
  std::uint64_t accepted = 0;   ///< samples since the channel opened
  std::uint64_t lost = 0;       ///< missing or refused; not those of a silence
  std::uint64_t in_window = 0;  ///< positions of this stretch
  std::array<AxisEvidence, kAxes> axis{};
};

/// One a channel, the intake's. A function of the calls: no clock. Allocates nothing.
class HealthWatch {
 public:
  HealthWatch(const HealthOptions& options, std::size_t window_samples) noexcept;

  /// The next position of the time base. @param measured false for a bridged one, which has no value of its own
  void step(const Sample& sample, bool measured) noexcept;
  void lose(std::uint64_t samples) noexcept { evidence_.lost += samples; }
  /// What comes next does not join what was.
  void begin_stretch() noexcept;
  /// A block of samples has been judged.
  void take_block(const RestEvidence& rest) noexcept;
  void hear(double now_s, double sample_rate_hz) noexcept;
  void end() noexcept { evidence_.ended = true; }

  [[nodiscard]] const HealthEvidence& evidence() const noexcept { return evidence_; }

 private:
  /// Of one axis, what the evidence is made from.
  struct Axis {
    double value = 0.0;
    std::int64_t same_since_ns = 0;
    std::uint64_t same_samples = 0;
    double extreme = 0.0;                 ///< largest magnitude so far, rad/s
    unsigned plateaus = 0;                ///< visits of three equal samples at it
    std::array<std::uint64_t, 3> hits{};  ///< numbers of the newest samples at the limit, newest first
    std::uint64_t hit_count = 0;
    std::int64_t saturated_ns = 0;
    double louder_s = 0.0;
    double usual_deviation = 0.0;  ///< that louder_s and noisy refer to
    double off_s = 0.0;
  };

  void watch_value(std::size_t axis, double value, std::int64_t stamp_ns) noexcept;
  void watch_range(Axis& axis, double magnitude) noexcept;
  [[nodiscard]] double limit_of(const Axis& axis) const noexcept;
  void watch_noise(std::size_t axis, const RestEvidence& rest) noexcept;
  void watch_bias(std::size_t axis, const RestEvidence& rest) noexcept;

  HealthOptions options_;
  std::uint64_t window_samples_;
  HealthEvidence evidence_;
  std::array<Axis, kAxes> axes_{};
  bool fresh_ = true;  ///< the next sample is the first of its stretch
};

}  // namespace gyrod::stream
