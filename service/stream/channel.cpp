#include "stream/channel.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace gyrod::stream {
namespace {

HopSchedule::Options schedule_options(const EngineOptions& options) {
  return {.window = static_cast<Position>(options.window_samples),
          .hop = static_cast<Position>(options.hop_samples),
          .max_hop = static_cast<Position>(options.max_hop_samples),
          .lag = static_cast<Position>(options.lag_samples)};
}

}  // namespace

unsigned doublings_at(const EngineOptions& options, double sample_rate_hz) noexcept {
  return options.stretch_windows ? doublings_at(sample_rate_hz, options.window_samples) : 0;
}

std::size_t channel_positions(const EngineOptions& options, unsigned doublings) noexcept {
  return (options.window_samples + options.max_queued_windows * options.hop_samples +
          2 * options.max_hop_samples)
         << doublings;
}

std::size_t most_held_samples(const EngineOptions& options) noexcept { return channel_positions(options, 0); }

Channel::Channel(std::string sensor, const EngineOptions& options, const ModelMethodFactory* models)
    : gate({options.sample_rate_hz, options.max_rate_radps, options.max_bridged_samples}),
      schedule(schedule_options(options)),
      ring(channel_positions(options, 0)),
      watch(options.health, options.window_samples),
      sensor_(std::move(sensor)),
      jobs_(options.max_queued_windows),
      judge_(options.health, options.window_samples) {
  if (models != nullptr) {
    fast_loop.emplace(*models, options.window_samples, options.lag_samples);
  } else {
    splice.emplace(options.lag_samples);
  }
  if (options.noise) noise = options.noise(sensor_);
  if (options.learner) learner = options.learner(sensor_);
  if (options.published_before) published_before_ = options.published_before(sensor_);
  hop_samples_ = static_cast<std::uint32_t>(options.hop_samples);
}

void Channel::append(const Sample& sample, Place place) {
  ring.append(sample, place == Place::kMeasured);
  watch.step(sample, place != Place::kBridged);
  if (!learner) return;
  learner->step(sample, place != Place::kBridged, gate.rate_hz());
  if (const RestEvidence* rest = learner->evidence()) take_block(*rest);
  if (const auto update = learner->update()) noise = *update;
}

void Channel::take_block(const RestEvidence& rest) {
  watch.take_block(rest);
  const std::lock_guard lock(mutex_);
  curves_ = rest.curves;
  curves_rate_hz_ = rest.sample_rate_hz;
  bias_radps_ = rest.bias_radps;
  bias_s_ = rest.bias_s;
}

void Channel::hear(double now_s) {
  watch.hear(now_s, gate.rate_hz());
  look_for_history(now_s);
  heard_s_ = now_s;
  if (state_ != ChannelState::kActive) state_ = ChannelState::kActive;
}

void Channel::fall_silent(ChannelState why) {
  state_ = why;
  const std::lock_guard lock(mutex_);
  ++counts_.silences;
}

void Channel::show_health() {
  const std::lock_guard lock(mutex_);
  evidence_ = watch.evidence();
}

bool Channel::has_room() const {
  Position oldest = schedule.oldest_needed(ring.end());
  const std::lock_guard lock(mutex_);
  if (job_count_ > 0) oldest = std::min(oldest, jobs_[first_job_].begin);
  return ring.end() - oldest < static_cast<Position>(ring.capacity());
}

bool Channel::can_submit() const {
  const std::lock_guard lock(mutex_);
  return job_count_ < jobs_.size();
}

bool Channel::submit(const WindowJob& job) {
  const std::lock_guard lock(mutex_);
  assert(job_count_ < jobs_.size());
  jobs_[(first_job_ + job_count_) % jobs_.size()] = job;
  ++job_count_;
  hop_samples_ = job.hop_samples;
  rate_hz_ = job.sample_rate_hz;
  return must_schedule();
}

bool Channel::must_schedule() {
  if (owned_ || scheduled_ || job_count_ == 0) return false;
  return scheduled_ = true;
}

void Channel::count_received() {
  const std::lock_guard lock(mutex_);
  // Received and in flight until judged: the sum holds at every moment.
  ++counts_.received;
  ++counts_.in_flight;
}

void Channel::count_rejected(RejectReason reason) {
  const std::lock_guard lock(mutex_);
  --counts_.in_flight;
  ++counts_.rejected[static_cast<std::size_t>(reason)];
}

void Channel::count_accepted(const Verdict& verdict) {
  if (verdict.kind == Verdict::Kind::kAccept && verdict.missing == 0) return;
  const std::lock_guard lock(mutex_);
  counts_.missing += verdict.missing;
  counts_.gaps += verdict.kind == Verdict::Kind::kGap ? 1U : 0U;
  counts_.restarts += verdict.kind == Verdict::Kind::kRestart ? 1U : 0U;
}

void Channel::count_bridged() {
  const std::lock_guard lock(mutex_);
  ++counts_.bridged;
}

void Channel::count_widened() {
  const std::lock_guard lock(mutex_);
  ++counts_.hops_widened;
}

void Channel::count_realtime(std::size_t samples) {
  const std::lock_guard lock(mutex_);
  counts_.realtime += samples;
}

void Channel::count_misfits(std::uint64_t misfits) {
  if (misfits == 0) return;
  const std::lock_guard lock(mutex_);
  counts_.misfits += misfits;
}

std::optional<WindowJob> Channel::begin_work(bool scheduled) {
  const std::lock_guard lock(mutex_);
  if (scheduled) scheduled_ = false;
  if (owned_ || job_count_ == 0) return std::nullopt;
  owned_ = true;
  return jobs_[first_job_];
}

bool Channel::end_work(bool denoised) {
  const std::lock_guard lock(mutex_);
  assert(owned_);
  owned_ = false;
  first_job_ = (first_job_ + 1) % jobs_.size();
  --job_count_;
  if (denoised) ++counts_.windows;
  return must_schedule();
}

void Channel::offer_models(const ModelOrigin& origin) {
  const std::lock_guard lock(mutex_);
  offered_ = origin;
}

std::optional<ModelOrigin> Channel::take_models() {
  const std::lock_guard lock(mutex_);
  return std::exchange(offered_, std::nullopt);
}

void Channel::count_published(std::span<const DenoisedSample> samples) {
  const auto flagged = [samples](SampleFlag flag) {
    return static_cast<std::uint64_t>(
        std::count_if(samples.begin(), samples.end(), [flag](const DenoisedSample& sample) {
          return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
        }));
  };
  const std::uint64_t warming_up = flagged(SampleFlag::kWarmingUp);
  const std::uint64_t passed_through = flagged(SampleFlag::kPassThrough);
  const bool widened = flagged(SampleFlag::kHopWidened) > 0;
  const std::lock_guard lock(mutex_);
  counts_.published += samples.size();
  counts_.in_flight -= samples.size();
  counts_.warming_up += warming_up;
  counts_.passed_through += passed_through;
  if (widened) worst_step_ = std::max(worst_step_, 1U);
}

void Channel::set_pass_through(bool active) {
  const std::lock_guard lock(mutex_);
  if (active && !pass_through_) ++counts_.overloads;
  pass_through_ = active;
  if (active) worst_step_ = 2U;
}

void Channel::keep_report(const NoiseReport& report) {
  const std::lock_guard lock(mutex_);
  last_report_ = report;
}

std::uint64_t Channel::next_epoch() {
  const std::lock_guard lock(mutex_);
  return ++epoch_;
}

std::optional<double> Channel::oldest_submission() const {
  const std::lock_guard lock(mutex_);
  if (job_count_ == 0) return std::nullopt;
  return jobs_[first_job_].submitted_s;
}

bool Channel::idle() const {
  const std::lock_guard lock(mutex_);
  return !owned_ && !scheduled_ && job_count_ == 0;
}

Channel::Judgement Channel::judge_health(HealthContext context) {
  const std::lock_guard lock(mutex_);
  const bool widened = (last_report_.flags & static_cast<std::uint32_t>(SampleFlag::kHopWidened)) != 0;
  const unsigned step = pass_through_ ? 2U : static_cast<unsigned>(widened);
  context.overload_step = std::max(step, std::exchange(worst_step_, step));
  const SensorHealth before = health_.value_or(SensorHealth{});
  const SensorHealth now = judge_.judge(evidence_, context);
  const auto differs = [&](std::size_t axis) { return before.axis[axis].state != now.axis[axis].state; };
  const bool changed = !health_ || differs(0) || differs(1) || differs(2);
  health_ = now;
  return {before, now, changed, context.overload_step};
}

std::optional<AllanCurves> Channel::curves_to_fit(double& sample_rate_hz) const {
  constexpr std::uint64_t kFewestTerms = 1000;
  const std::lock_guard lock(mutex_);
  sample_rate_hz = curves_rate_hz_;
  const std::uint64_t terms = curves_[0].terms[0];
  const bool more = terms < fitted_terms_ || terms - fitted_terms_ > fitted_terms_ / 10;
  if (!more || (terms < kFewestTerms && fitted_terms_ == 0)) return std::nullopt;
  return curves_;
}

void Channel::keep_fit(const AllanCurves& fitted,
                       const std::array<core::NoiseCoefficients, kAxes>& coefficients) {
  const std::lock_guard lock(mutex_);
  fitted_terms_ = fitted[0].terms[0];
  coefficients_ = coefficients;
}

Counts Channel::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

ChannelSnapshot Channel::snapshot() const {
  const std::lock_guard lock(mutex_);
  return {.sensor = sensor_,
          .counts = counts_,
          .last_report = last_report_,
          .queued_windows = job_count_,
          .hop_samples = hop_samples_,
          .sample_rate_hz = rate_hz_,
          .pass_through = pass_through_,
          .state = state_,
          .health = health_,
          .curves = curves_,
          .curves_rate_hz = curves_rate_hz_,
          .bias_radps = bias_radps_,
          .bias_s = bias_s_,
          .coefficients = coefficients_};
}

}  // namespace gyrod::stream
