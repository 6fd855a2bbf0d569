#include "core/simulation/drive_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace gyrod::core {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Range {
  double low;
  double high;
};
constexpr Range kStraightS = {3.0, 12.0};
constexpr Range kTurnRateDps = {5.0, 30.0};
constexpr Range kTurnRiseS = {1.5, 3.0};
constexpr Range kTurnHoldS = {1.0, 4.0};
constexpr Range kDipDeg = {0.5, 1.5};
constexpr Range kBrakeS = {2.0, 4.0};
constexpr Range kStandS = {3.0, 12.0};
constexpr Range kVibrationHz = {6.0, 20.0};
/// Of the manoeuvres that are not straight.
constexpr double kTurnShare = 0.75;
/// Roll angle over yaw rate, s: about 5 deg of roll per g of lateral acceleration at 10 m/s.
constexpr double kRollPerYawRateS = 0.09;

double draw(Random& random, Range range) noexcept { return random.uniform(range.low, range.high); }

/// 6u^5 - 15u^4 + 10u^3: from 0 to 1 with two derivatives 0 at either end, and constant outside.
double smooth_step(double u) noexcept {
  const double v = std::clamp(u, 0.0, 1.0);
  return v * v * v * (10.0 + v * (6.0 * v - 15.0));
}

double smooth_step_slope(double u) noexcept {
  const double v = std::clamp(u, 0.0, 1.0);
  return 30.0 * v * v * (1.0 - v) * (1.0 - v);
}

/// Up over `rise`, 1 for `hold`, down over `rise`.
struct Profile {
  double value;
  double slope_per_s;
};
Profile profile_at(double t, double rise, double hold) noexcept {
  const double up = t / rise;
  const double down = (t - rise - hold) / rise;
  return {smooth_step(up) - smooth_step(down), (smooth_step_slope(up) - smooth_step_slope(down)) / rise};
}

/// Silent where the sample rate cannot carry it.
Oscillator tone(double frequency_hz, double period_s, double phase_turns) noexcept {
  const double turns_per_sample = frequency_hz * period_s;
  return turns_per_sample < 0.5 ? Oscillator(turns_per_sample, phase_turns) : Oscillator();
}

}  // namespace

DriveMotion::DriveMotion(const DriveOptions& options, double sample_rate_hz, std::uint64_t seed) noexcept
    : options_(options), period_s_(1.0 / sample_rate_hz), random_(seed) {
  assert(sample_rate_hz > 0.0);
  engine_ = tone(options.engine_tone_hz, period_s_, 0.0);
  for (auto& axis : vibration_) {
    for (auto& oscillator : axis) {
      const double frequency_hz = draw(random_, kVibrationHz);
      oscillator = tone(frequency_hz, period_s_, random_.uniform(-0.5, 0.5));
    }
  }
}

std::array<double, 3> DriveMotion::next() noexcept {
  if (step_ == steps_) plan_next();
  const double t = static_cast<double>(step_) * period_s_;
  ++step_;
  auto rate = body_rate(t);
  add_vibration(speed_share(t), rate);
  return rate;
}

/// Straight, something, straight, something, ...
void DriveMotion::plan_next() noexcept {
  if (manoeuvre_ != Manoeuvre::kStraight) {
    manoeuvre_ = Manoeuvre::kStraight;
    peak_ = 0.0;
    hold_s_ = draw(random_, kStraightS);
    rise_s_ = 0.0;
  } else if (random_.uniform() < kTurnShare) {
    manoeuvre_ = Manoeuvre::kTurn;
    const double side = random_.uniform() < 0.5 ? -1.0 : 1.0;
    peak_ = side * kDegree * draw(random_, kTurnRateDps);
    rise_s_ = draw(random_, kTurnRiseS);
    hold_s_ = draw(random_, kTurnHoldS);
  } else {
    manoeuvre_ = Manoeuvre::kStop;
    peak_ = kDegree * draw(random_, kDipDeg);
    rise_s_ = draw(random_, kBrakeS);
    hold_s_ = draw(random_, kStandS);
  }
  step_ = 0;
  steps_ = static_cast<std::uint64_t>((2.0 * rise_s_ + hold_s_) / period_s_) + 1;
}

/// Rate without vibration, `t` seconds into the manoeuvre.
std::array<double, 3> DriveMotion::body_rate(double t) const noexcept {
  switch (manoeuvre_) {
    case Manoeuvre::kStraight:
      break;
    case Manoeuvre::kTurn: {
      const Profile yaw = profile_at(t, rise_s_, hold_s_);
      return {kRollPerYawRateS * peak_ * yaw.slope_per_s, 0.0, peak_ * yaw.value};
    }
    case Manoeuvre::kStop: {
      // The nose dips (pitch about y to the left is positive nose down) while braking, is level at rest,
      // squats on leaving.
      const Profile braking = profile_at(t, 0.5 * rise_s_, 0.0);
      const Profile leaving = profile_at(t - rise_s_ - hold_s_, 0.5 * rise_s_, 0.0);
      return {0.0, peak_ * (braking.slope_per_s - leaving.slope_per_s), 0.0};
    }
  }
  return {};
}

/// Speed over cruising speed, `t` seconds into the manoeuvre.
double DriveMotion::speed_share(double t) const noexcept {
  return manoeuvre_ == Manoeuvre::kStop ? 1.0 - profile_at(t, rise_s_, hold_s_).value : 1.0;
}

void DriveMotion::add_vibration(double share, std::array<double, 3>& rate) noexcept {
  // A sine has variance 1/2, so the sum has the standard deviation asked for.
  const double amplitude =
      options_.road_vibration_radps * std::sqrt(2.0 / static_cast<double>(kVibrationTones));
  const double engine = options_.engine_tone_radps * engine_.next();
  for (std::size_t axis = 0; axis < rate.size(); ++axis) {
    double sum = 0.0;
    for (auto& oscillator : vibration_[axis]) sum += oscillator.next();
    rate[axis] += share * amplitude * sum + engine;
  }
}

}  // namespace gyrod::core
