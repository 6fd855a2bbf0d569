#include "stream/health_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gyrod::stream {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;
/// Samples of one value that make a plateau, and samples in a window that make a saturated axis.
constexpr std::uint64_t kPlateau = 3;
/// Plateaus at the largest rate so far that make it the sensor's limit.
constexpr unsigned kPlateausToLearn = 2;
/// No gyro has a smaller range: 57 deg/s. Below, equal values are a coarse converter at rest.
constexpr double kLeastRange_radps = 1.0;
/// The two ends of a converter's range differ by one step of 2^15.
constexpr double kSameLimit = 1e-4;
/// What a sensor that is turned over sees of the earth's rotation, rad/s: 30 deg/h.
constexpr double kEarth_radps = 2.0 * 7.292115e-5;
/// A bias is compared with one that took so long to learn, s.
constexpr double kFewestBiasSeconds = 60.0;
constexpr double kDriftAfter_s = 10.0;
/// Drifting no longer below this part of the limit.
constexpr double kRelearned = 0.6;
/// Clusters that the Allan deviation must rest on to foretell anything.
constexpr std::uint64_t kFewestClusters = 3;

/// Largest Allan deviation at the cluster times of eight blocks and more; 0 where none is known.
double wander_of(const core::AllanSums& sums, const RestEvidence& rest) noexcept {
  constexpr double kBlocks = 8.0;
  double most = 0.0;
  for (std::size_t j = 0; j < core::kAllanOctaves; ++j) {
    const double tau_s = static_cast<double>(core::allan_cluster(j)) / rest.sample_rate_hz;
    const std::uint64_t terms_a_cluster = core::allan_cluster(j) / core::allan_stride(j);
    const bool tells = sums.terms[j] >= kFewestClusters * terms_a_cluster;
    if (tells && tau_s >= kBlocks * rest.block_s) most = std::max(most, core::allan_deviation_of(sums, j));
  }
  return most;
}

}  // namespace

HealthWatch::HealthWatch(const HealthOptions& options, std::size_t window_samples) noexcept
    : options_(options), window_samples_(window_samples) {}

void HealthWatch::hear(double now_s, double sample_rate_hz) noexcept {
  evidence_.heard_s = now_s;
  evidence_.sample_rate_hz = sample_rate_hz;
  evidence_.ended = false;
}

void HealthWatch::begin_stretch() noexcept {
  evidence_.in_window = 0;
  fresh_ = true;
}

void HealthWatch::step(const Sample& sample, bool measured) noexcept {
  ++evidence_.in_window;
  if (!measured) return;
  ++evidence_.accepted;
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    watch_value(axis, sample.rate_radps[axis], sample.stamp_ns);
  fresh_ = false;
}

void HealthWatch::watch_value(std::size_t axis, double value, std::int64_t stamp_ns) noexcept {
  Axis& seen = axes_[axis];
  AxisEvidence& evidence = evidence_.axis[axis];
  if (fresh_) seen.hit_count = 0;
  if (fresh_ || value != seen.value) {
    seen.same_since_ns = stamp_ns;
    seen.same_samples = 0;
  }
  seen.value = value;
  ++seen.same_samples;
  evidence.same_s = static_cast<double>(stamp_ns - seen.same_since_ns) * kSecondsPerNanosecond;
  const std::uint64_t triples_before = seen.hit_count;
  watch_range(seen, std::abs(value));
  const bool triple = seen.hit_count > triples_before && seen.hit_count >= kPlateau &&
                      seen.hits[0] - seen.hits[2] < window_samples_;
  const bool ever = evidence.since_saturated_s >= 0.0;
  if (triple) {
    seen.saturated_ns = stamp_ns;
  } else if (fresh_ && ever) {  // the clock may have jumped: what has passed stands still over the break
    seen.saturated_ns = stamp_ns - std::llround(evidence.since_saturated_s / kSecondsPerNanosecond);
  }
  if (triple || ever)
    evidence.since_saturated_s = static_cast<double>(stamp_ns - seen.saturated_ns) * kSecondsPerNanosecond;
}

/// Learns the limit, and notes a sample that is at it.
void HealthWatch::watch_range(Axis& axis, double magnitude) noexcept {
  if (magnitude > axis.extreme * (1.0 + kSameLimit)) {
    axis.extreme = magnitude;
    axis.plateaus = 0;
  }
  const bool at_extreme = magnitude >= axis.extreme * (1.0 - kSameLimit) && axis.extreme >= kLeastRange_radps;
  if (at_extreme && axis.same_samples == kPlateau) ++axis.plateaus;
  const double limit = limit_of(axis);
  if (!(limit > 0.0) || magnitude < limit * (1.0 - kSameLimit)) return;
  axis.hits = {evidence_.accepted, axis.hits[0], axis.hits[1]};
  ++axis.hit_count;
}

double HealthWatch::limit_of(const Axis& axis) const noexcept {
  if (options_.range_radps > 0.0) return options_.range_radps;
  return axis.plateaus >= kPlateausToLearn ? axis.extreme : 0.0;
}

void HealthWatch::take_block(const RestEvidence& rest) noexcept {
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    watch_noise(axis, rest);
    watch_bias(axis, rest);
  }
}

/// A break of the rest begins anew; what was found before it stays until a rest says otherwise.
void HealthWatch::watch_noise(std::size_t axis, const RestEvidence& rest) noexcept {
  Axis& seen = axes_[axis];
  AxisEvidence& evidence = evidence_.axis[axis];
  if (!rest.looks_at_rest) {
    seen.louder_s = 0.0;
    return;
  }
  // What is learned follows the noise: while it is being judged, the level from before it rose.
  if (!evidence.noisy && seen.louder_s == 0.0) seen.usual_deviation = rest.usual_deviation_radps[axis];
  if (!(seen.usual_deviation > 0.0)) return;
  evidence.noise_ratio = rest.deviation_radps[axis] / seen.usual_deviation;
  if (evidence.noise_ratio > options_.noisy_ratio) {
    seen.louder_s += rest.block_s;
    evidence.noisy = evidence.noisy || seen.louder_s >= options_.noisy_after_s;
  } else {
    seen.louder_s = 0.0;
    evidence.noisy = evidence.noisy && evidence.noise_ratio >= options_.noisy_clear_ratio;
  }
}

void HealthWatch::watch_bias(std::size_t axis, const RestEvidence& rest) noexcept {
  Axis& seen = axes_[axis];
  AxisEvidence& evidence = evidence_.axis[axis];
  if (!rest.looks_at_rest) {
    seen.off_s = 0.0;
    return;
  }
  const double wander = wander_of(rest.curves[axis], rest);
  if (!(wander > 0.0) || rest.bias_s < kFewestBiasSeconds) return;
  // Of the difference of two means that each wander so.
  evidence.bias_limit_radps = options_.drift_sigmas * std::numbers::sqrt2 * wander + kEarth_radps;
  evidence.bias_offset_radps = std::abs(rest.mean_radps[axis] - rest.bias_radps[axis]);
  seen.off_s = evidence.bias_offset_radps > evidence.bias_limit_radps ? seen.off_s + rest.block_s : 0.0;
  if (seen.off_s >= kDriftAfter_s) evidence.drifting = true;
  if (evidence.bias_offset_radps < kRelearned * evidence.bias_limit_radps) evidence.drifting = false;
}

}  // namespace gyrod::stream
