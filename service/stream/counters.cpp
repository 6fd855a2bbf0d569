#include "stream/counters.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace gyrod::stream {

std::string_view name_of(ChannelState state) noexcept {
  switch (state) {
    case ChannelState::kActive:
      break;
    case ChannelState::kSilent:
      return "silent";
    case ChannelState::kDeadlineMissed:
      return "deadline_missed";
    case ChannelState::kLivelinessLost:
      return "liveliness_lost";
    case ChannelState::kEnded:
      return "ended";
  }
  return "active";
}

std::string_view name_of(NoiseSource source) noexcept {
  switch (source) {
    case NoiseSource::kNone:
      break;
    case NoiseSource::kImf1:
      return "imf1";
    case NoiseSource::kStandstill:
      return "standstill";
    case NoiseSource::kCalibrated:
      return "calibrated";
  }
  return "none";
}

std::string_view name_of(RejectReason reason) noexcept {
  static constexpr std::array<std::string_view, kRejectReasons> kNames = {
      "not_finite",        "out_of_range",  "duplicate",     "out_of_order", "time_backwards",
      "too_many_channels", "bad_sensor_id", "shutting_down", "history"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::uint64_t Counts::rejected_total() const noexcept {
  return std::accumulate(rejected.begin(), rejected.end(), std::uint64_t{0});
}

Counts& Counts::operator+=(const Counts& other) noexcept {
  received += other.received;
  published += other.published;
  in_flight += other.in_flight;
  std::transform(rejected.begin(), rejected.end(), other.rejected.begin(), rejected.begin(), std::plus<>{});
  missing += other.missing;
  bridged += other.bridged;
  gaps += other.gaps;
  restarts += other.restarts;
  windows += other.windows;
  warming_up += other.warming_up;
  passed_through += other.passed_through;
  hops_widened += other.hops_widened;
  overloads += other.overloads;
  realtime += other.realtime;
  misfits += other.misfits;
  silences += other.silences;
  return *this;
}

void TimeHistogram::add(double seconds) noexcept {
  const auto bound = std::lower_bound(kUpperBoundsS.begin(), kUpperBoundsS.end(), seconds);
  ++buckets[static_cast<std::size_t>(std::distance(kUpperBoundsS.begin(), bound))];
  ++count;
  sum_s += seconds;
}

TimeHistogram& TimeHistogram::operator+=(const TimeHistogram& other) noexcept {
  std::transform(buckets.begin(), buckets.end(), other.buckets.begin(), buckets.begin(), std::plus<>{});
  count += other.count;
  sum_s += other.sum_s;
  return *this;
}

}  // namespace gyrod::stream
