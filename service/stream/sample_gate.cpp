#include "stream/sample_gate.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::stream {
namespace {

/// Sequence numbers before the newest of which is known whether they came: bits of seen_.
constexpr std::uint64_t kRemembered = 64;

/// Samples of a sensor that does not count.
bool unnumbered(const Sample& sample, std::uint64_t last_sequence) noexcept {
  return sample.sequence == 0 && last_sequence == 0;
}

}  // namespace

SampleGate::SampleGate(const GateOptions& options) noexcept
    : options_(options), period_(options.sample_rate_hz) {}

Verdict SampleGate::judge(const Sample& sample) noexcept {
  if (const auto reason = unfit(sample)) {
    const bool newer = unnumbered(sample, last_sequence_) ? sample.stamp_ns > last_stamp_ns_
                                                          : sample.sequence > last_sequence_;
    if (open_ && newer) ++refused_ahead_;
    return {.kind = Verdict::Kind::kRefuse, .reason = *reason};
  }
  if (!open_) {
    const std::uint64_t missing = missing_since_end(sample);
    remember(sample);
    return {.missing = missing};
  }
  if (const auto reason = stale(sample)) {
    // A sample that comes a second time, stamp and all, is no sign of a new beginning, however many of them come.
    if (sample.sequence > last_sequence_) ++refused_ahead_;
    const bool repeated = *reason == RejectReason::kDuplicate && sample.stamp_ns <= last_stamp_ns_;
    const bool anew = (restart_expected_ && older_by_far(sample)) || begins_anew(sample);
    if (repeated || !anew) return {.kind = Verdict::Kind::kRefuse, .reason = *reason};
    reopen();
    remember(sample);
    return {.kind = Verdict::Kind::kRestart};
  }
  return advance(sample);
}

void SampleGate::reopen() noexcept {
  open_ = false;
  seen_ = 0;
  suspects_ = 0;
  refused_ahead_ = 0;
}

void SampleGate::forget() noexcept {
  reopen();
  ever_open_ = false;
}

std::optional<RejectReason> SampleGate::unfit(const Sample& sample) const noexcept {
  for (const double rate : sample.rate_radps) {
    if (!std::isfinite(rate)) return RejectReason::kNotFinite;
    if (std::abs(rate) > options_.max_rate_radps) return RejectReason::kOutOfRange;
  }
  return std::nullopt;
}

std::optional<RejectReason> SampleGate::stale(const Sample& sample) const noexcept {
  const bool without_number = unnumbered(sample, last_sequence_);
  if (!without_number && sample.sequence <= last_sequence_) {
    const std::uint64_t age = last_sequence_ - sample.sequence;
    const bool seen = age < kRemembered && ((seen_ >> age) & 1U) != 0;
    return seen ? RejectReason::kDuplicate : RejectReason::kOutOfOrder;
  }
  if (sample.stamp_ns > last_stamp_ns_) return std::nullopt;
  return without_number && sample.stamp_ns == last_stamp_ns_ ? RejectReason::kDuplicate
                                                             : RejectReason::kTimeBackwards;
}

/// A network that was gone, not a sensor that began anew: then numbers and stamps have advanced alike.
std::uint64_t SampleGate::missing_since_end(const Sample& sample) const noexcept {
  constexpr double kAlike =
      0.05;  // of the numbers: clocks and the estimated period are better, other numberings far worse
  if (!ever_open_ || sample.sequence <= last_sequence_ || sample.stamp_ns <= last_stamp_ns_) return 0;
  const std::uint64_t step = sample.sequence - last_sequence_;
  const auto numbers = static_cast<double>(step);
  // Wrapping subtraction, as in advance().
  const auto interval_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(sample.stamp_ns) -
                                                     static_cast<std::uint64_t>(last_stamp_ns_));
  const double periods = periods_in(interval_ns);
  const bool goes_on = step <= kLargestLoss && std::abs(periods - numbers) <= kAlike * numbers;
  return goes_on ? step - 1 : 0;
}

/// By stamp where there are numbers, too: a sensor that reboots soon has small ones before and after.
bool SampleGate::older_by_far(const Sample& sample) const noexcept {
  // Wrapping subtraction, as in advance().
  const auto back_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(last_stamp_ns_) -
                                                 static_cast<std::uint64_t>(sample.stamp_ns));
  const bool by_number = sample.sequence < last_sequence_ && last_sequence_ - sample.sequence >= kRemembered;
  return by_number || back_ns > kLongestPauseNs;
}

bool SampleGate::begins_anew(const Sample& sample) noexcept {
  const bool numbered = sample.sequence != 0 || suspect_.sequence != 0;
  const bool agrees = suspects_ > 0 && sample.stamp_ns > suspect_.stamp_ns &&
                      (!numbered || sample.sequence > suspect_.sequence);
  suspects_ = agrees ? suspects_ + 1 : 1;
  suspect_ = sample;
  return suspects_ >= kAnew;
}

/// Sample periods in an interval; 0 while the period is not known.
double SampleGate::periods_in(std::int64_t interval_ns) const noexcept {
  return period_.period_ns() > 0.0 ? static_cast<double>(interval_ns) / period_.period_ns() : 0.0;
}

std::uint64_t SampleGate::missing_by_stamp(std::int64_t interval_ns) const noexcept {
  if (!(period_.period_ns() > 0.0)) return 0;
  if (!period_.regular() && interval_ns <= kLongestPauseNs) return 0;
  const double periods = periods_in(interval_ns);
  const double whole = std::round(periods);
  // A late stamp is no whole number of periods late; samples that are missing leave a whole number.
  const bool late = interval_ns <= kLongestPauseNs && std::abs(periods - whole) > PeriodEstimator::kTolerance;
  return whole > 1.0 && !late ? static_cast<std::uint64_t>(whole) - 1 : 0;
}

Verdict SampleGate::advance(const Sample& sample) noexcept {
  // A sensor that does not count has advanced by this sample and those that were refused.
  const std::uint64_t step =
      unnumbered(sample, last_sequence_) ? 1 + refused_ahead_ : sample.sequence - last_sequence_;
  // Wrapping subtraction: stamps of opposite ends of the clock differ by more than an int64 holds.
  const auto interval_ns = static_cast<std::int64_t>(static_cast<std::uint64_t>(sample.stamp_ns) -
                                                     static_cast<std::uint64_t>(last_stamp_ns_));
  const bool clock_set = sample.sequence != 0 && step == 1 && interval_ns > kClockSetNs;
  const bool renumbered = step > kLargestLoss || interval_ns < 0 || clock_set ||
                          periods_in(interval_ns) > static_cast<double>(kLargestLoss);
  const std::uint64_t by_sequence = renumbered ? 0 : step - 1;
  const std::uint64_t absent = renumbered ? 0 : std::max(by_sequence, missing_by_stamp(interval_ns));
  const std::uint64_t missing = absent - std::min(absent, refused_ahead_);
  const bool paused = interval_ns > kLongestPauseNs && absent == 0 && !(period_.period_ns() > 0.0);

  // Every interval counts, also one in which samples seem to be missing: a sensor that changes its rate is
  // thus noticed.
  const std::int64_t period_ns =
      renumbered ? 0 : interval_ns / static_cast<std::int64_t>(std::max<std::uint64_t>(step, 1));
  if (period_ns > 0) period_.add(period_ns);
  if (renumbered || paused || absent > options_.max_bridged_samples) {
    reopen();
    remember(sample);
    return {.kind = renumbered ? Verdict::Kind::kRestart : Verdict::Kind::kGap, .missing = missing};
  }
  remember(sample);
  return {.kind = Verdict::Kind::kAccept, .bridge = absent, .missing = missing};
}

void SampleGate::remember(const Sample& sample) noexcept {
  const std::uint64_t step = sample.sequence - last_sequence_;
  seen_ = open_ && step < kRemembered ? (seen_ << step) | 1U : 1U;
  open_ = ever_open_ = true;
  last_sequence_ = sample.sequence;
  last_stamp_ns_ = sample.stamp_ns;
  refused_ahead_ = 0;
  suspects_ = 0;
  restart_expected_ = false;
}

}  // namespace gyrod::stream
