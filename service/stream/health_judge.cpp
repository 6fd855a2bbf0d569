#include "stream/health_judge.hpp"

#include <algorithm>

namespace gyrod::stream {
namespace {

/// Silent: so many sample periods without one, too.
constexpr double kSilentPeriods = 10.0;
/// Fewer lost samples make no share: one of the first twenty is 5 %.
constexpr std::uint64_t kFewestLost = 5;

const AxisHealth& worse(const AxisHealth& a, const AxisHealth& b) noexcept {
  return static_cast<int>(b.state) > static_cast<int>(a.state) ? b : a;
}

}  // namespace

std::string_view name_of(Health health) noexcept {
  static constexpr std::array<std::string_view, kHealthStates> kNames = {
      "ok", "warming_up", "degraded", "lossy", "drifting", "noisy", "saturated", "stuck", "silent"};
  return kNames[static_cast<std::size_t>(health)];
}

HealthJudge::HealthJudge(const HealthOptions& options, std::size_t window_samples) noexcept
    : options_(options), window_samples_(window_samples) {}

SensorHealth HealthJudge::judge(const HealthEvidence& evidence, const HealthContext& context) noexcept {
  watch_loss(evidence, context.now_s);
  const AxisHealth of_all = judge_sensor(evidence, context);
  SensorHealth health{.state = Health::kOk, .axis = {}};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    health.axis[axis] = worse(of_all, judge_axis(evidence, axis));
    health.state = std::max(health.state, health.axis[axis].state);
  }
  return health;
}

/// What holds for all axes: silent, lossy, degraded, warming up.
AxisHealth HealthJudge::judge_sensor(const HealthEvidence& evidence, const HealthContext& context) noexcept {
  const double since_s = std::max(evidence.heard_s, context.deaf_until_s);
  const double periods_s = evidence.sample_rate_hz > 0.0 ? kSilentPeriods / evidence.sample_rate_hz : 0.0;
  const double silent_after_s = std::max(options_.silent_after_s, periods_s);
  const double quiet_s = context.now_s - since_s;
  if (evidence.ended || quiet_s > silent_after_s) return {Health::kSilent, quiet_s, silent_after_s};
  if (lossy_) return {Health::kLossy, share_, options_.lossy_share};
  if (context.overload_step > 0) return {Health::kDegraded, static_cast<double>(context.overload_step), 1.0};
  if (evidence.in_window < window_samples_) {
    return {Health::kWarmingUp, static_cast<double>(evidence.in_window),
            static_cast<double>(window_samples_)};
  }
  return {Health::kOk, 0.0, 0.0};
}

AxisHealth HealthJudge::judge_axis(const HealthEvidence& evidence, std::size_t axis) const noexcept {
  const AxisEvidence& seen = evidence.axis[axis];
  if (is_stuck(evidence, axis)) return {Health::kStuck, seen.same_s, options_.stuck_after_s};
  const bool saturated = seen.since_saturated_s >= 0.0 && seen.since_saturated_s <= options_.saturated_hold_s;
  if (saturated) return {Health::kSaturated, seen.since_saturated_s, options_.saturated_hold_s};
  if (seen.noisy) return {Health::kNoisy, seen.noise_ratio, options_.noisy_ratio};
  if (seen.drifting) return {Health::kDrifting, seen.bias_offset_radps, seen.bias_limit_radps};
  return {Health::kOk, 0.0, 0.0};
}

bool HealthJudge::is_stuck(const HealthEvidence& evidence, std::size_t axis) const noexcept {
  const double same_s = evidence.axis[axis].same_s;
  const bool another_moves = std::ranges::any_of(
      evidence.axis, [this](const AxisEvidence& other) { return other.same_s < options_.stuck_after_s; });
  return same_s >= (another_moves ? options_.stuck_after_s : options_.all_stuck_after_s);
}

/// Sums a sixtieth of the window apart, so that the share is of the last 60 to 61 parts.
void HealthJudge::watch_loss(const HealthEvidence& evidence, double now_s) noexcept {
  const double part_s = options_.loss_window_s / static_cast<double>(kParts);
  const auto newest = [this]() -> const Sum& { return sums_[(first_ + count_ - 1) % sums_.size()]; };
  if (count_ == 0 || now_s - newest().time_s >= part_s) {
    if (count_ == sums_.size()) {
      first_ = (first_ + 1) % sums_.size();
      --count_;
    }
    sums_[(first_ + count_) % sums_.size()] = {now_s, evidence.accepted, evidence.lost};
    ++count_;
  }
  while (count_ > 1 && now_s - sums_[(first_ + 1) % sums_.size()].time_s >= options_.loss_window_s) {
    first_ = (first_ + 1) % sums_.size();
    --count_;
  }
  const std::uint64_t lost = evidence.lost - sums_[first_].lost;
  const std::uint64_t all = lost + evidence.accepted - sums_[first_].accepted;
  share_ = all > 0 ? static_cast<double>(lost) / static_cast<double>(all) : 0.0;
  if (lost >= kFewestLost && share_ > options_.lossy_share) lossy_ = true;
  if (share_ < options_.lossy_clear_share) lossy_ = false;
}

}  // namespace gyrod::stream
