/// The true angular rate of a car on a plausible drive, sample by sample for as long as one likes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/simulation/oscillator.hpp"
#include "core/simulation/random.hpp"

namespace gyrod::core {

struct DriveOptions {
  /// Road vibration while moving, rad/s, standard deviation on each axis, 6 to 20 Hz; 0 switches it off.
  double road_vibration_radps = 0.003;
  /// Engine tone on each axis, rad/s, amplitude; 0 switches it off. Default: off (rubber mounts do their
  /// work).
  double engine_tone_radps = 0.0;
  /// Frequency of the engine tone, Hz: idle speed of a four-cylinder engine, two firings a turn. Above 0,
  /// below half the sample rate, else the tone is left out, as an anti-alias filter would.
  double engine_tone_hz = 27.0;
};

/// Car axes: x forward, y left, z up. The drive is a chain of manoeuvres drawn from a seeded generator:
///   straight  3 to 12 s;
///   turn      yaw rate up to 5..30 deg/s either way, rising and falling over 1.5..3 s, held 1..4 s; the
///             body rolls with it;
///   stop      nose dips 0.5..1.5 deg while braking over 2..4 s, stands 3..12 s, squats on leaving; no road
///             vibration at rest.
/// Each profile is the quintic step 6u^5 - 15u^4 + 10u^3 up and down, so the rates have two continuous
/// derivatives; pitch and roll come back to where they were. Small angles: rates add, axes do not turn with
/// the body. Deterministic in (options, sample rate, seed); allocates nothing.
class DriveMotion {
 public:
  /// @pre sample_rate_hz > 0, options within their ranges
  DriveMotion(const DriveOptions& options, double sample_rate_hz, std::uint64_t seed) noexcept;

  /// True rate about x, y, z at the next sample, rad/s.
  [[nodiscard]] std::array<double, 3> next() noexcept;

 private:
  enum class Manoeuvre { kStraight, kTurn, kStop };
  static constexpr std::size_t kVibrationTones = 5;

  void plan_next() noexcept;
  [[nodiscard]] std::array<double, 3> body_rate(double t) const noexcept;
  [[nodiscard]] double speed_share(double t) const noexcept;
  void add_vibration(double share, std::array<double, 3>& rate) noexcept;

  DriveOptions options_;
  double period_s_;
  Random random_;
  Manoeuvre manoeuvre_ = Manoeuvre::kStop;
  std::uint64_t step_ = 0;   ///< samples since the manoeuvre began
  std::uint64_t steps_ = 0;  ///< samples it takes
  double peak_ = 0.0;        ///< turn: yaw rate, rad/s; stop: pitch angle, rad
  double rise_s_ = 1.0;
  double hold_s_ = 0.0;
  std::array<std::array<Oscillator, kVibrationTones>, 3> vibration_;
  Oscillator engine_;
};

}  // namespace gyrod::core
