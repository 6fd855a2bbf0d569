#include "stream/engine.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "stream/engine_impl.hpp"

namespace gyrod::stream {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <typename Number>
void require(const char* name, Number value, Number least, Number most) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument(std::string{name} + " is " + std::to_string(value) + ", expected " +
                              std::to_string(least) + " to " + std::to_string(most));
}

std::size_t longest_lag(const EngineOptions& options, const MethodFactory& method) {
  const std::size_t quarter = options.window_samples / 4;
  return std::holds_alternative<ModelMethodFactory>(method) ? std::min(quarter, kMaxModelLagSamples)
                                                            : quarter;
}

const EngineOptions& validated(const EngineOptions& options, const MethodFactory& method) {
  const std::size_t window = options.window_samples;
  require<std::size_t>("window_samples", window, 64, kLongestWindow);
  require<std::size_t>("hop_samples", options.hop_samples, 1, window / 2);
  require<std::size_t>("max_hop_samples", options.max_hop_samples, options.hop_samples, window / 2);
  require<std::size_t>("lag_samples", options.lag_samples, 0, longest_lag(options, method));
  require<std::size_t>("max_queued_windows", options.max_queued_windows, 1, 64);
  require<std::size_t>("workers", options.workers, 0, 1024);
  require<std::size_t>("max_channels", options.max_channels, 1, 100'000);
  require<std::size_t>("max_bridged_samples", options.max_bridged_samples, 0, window / 4);
  require("sample_rate_hz", options.sample_rate_hz, 0.0, 1e6);
  require("max_rate_radps", options.max_rate_radps, std::numeric_limits<double>::min(), 1e6);
  require("max_delay_s", options.max_delay_s, 0.01, 3600.0);
  constexpr double kDay_s = 86400.0;
  require("silent_after_s", options.silent_after_s, 0.0, kDay_s);
  if (options.forget_after_s != 0.0)
    require("forget_after_s", options.forget_after_s, options.silent_after_s, 365.0 * kDay_s);
  return options;
}

}  // namespace

Engine::Impl::Impl(EngineOptions options, MethodFactory method, Sink& sink, Clock clock)
    : options_(validated(options, method)),
      method_(std::move(method)),
      sink_(sink),
      clock_(clock ? std::move(clock) : Clock{steady_seconds}),
      registry_(options_.max_channels) {
  for (std::size_t i = 0; i <= options_.workers; ++i)
    benches_.push_back(std::make_unique<Workbench>(options_, method_));
  outbox_.reserve(kMaxModelReleaseSamples);
  realtime_outbox_.reserve(kMaxModelReleaseSamples);
  if (options_.workers == 0) return;
  scheduler_.emplace(options_.workers, options_.max_channels, [this](std::size_t worker, Channel& channel) {
    work(channel, *benches_[worker], true);
  });
}

void Engine::Impl::submit(Channel& channel, WindowJob job) {
  job.sample_rate_hz = channel.gate.rate_hz();
  job.noise = channel.noise;
  if (channel.learner) job.at_rest = channel.learner->at_rest();
  if (channel.fast_loop) {
    job.model_fit = channel.fast_loop->model_fit();
    job.output_variance = channel.fast_loop->take_mean_variance();
    if (channel.fast_loop->misfit()) job.flags |= static_cast<std::uint32_t>(SampleFlag::kModelMisfit);
    if (channel.models_late) job.flags |= static_cast<std::uint32_t>(SampleFlag::kHopWidened);
  }
  job.submitted_s = clock_();  // before the wait, which is part of the latency
  wait_while(channel, [&channel] { return !channel.can_submit(); });
  {
    const std::lock_guard lock(idle_mutex_);
    ++outstanding_;
  }
  const bool must_schedule = channel.submit(job);
  if (!scheduler_) {
    work(channel, *benches_.back(), true);
  } else if (must_schedule) {
    scheduler_->ready(channel);
  }
}

/// Works on the channel's oldest window. @return false where there is none or another thread is at it
bool Engine::Impl::work(Channel& channel, Workbench& bench, bool scheduled) {
  const auto job = channel.begin_work(scheduled);
  if (!job) return false;
  const bool pass_through = too_late(job->submitted_s);
  const double begin_s = clock_();
  bench.work(channel, *job, pass_through);
  const double window_time_s = clock_() - begin_s;
  bench.set_window_time(window_time_s);
  release(channel, *job, bench);
  channel.set_pass_through(pass_through);
  bench.count_times(window_time_s, clock_() - job->submitted_s);
  if (channel.end_work(bench.has_report())) scheduler_->ready(channel);
  {
    const std::lock_guard lock(idle_mutex_);
    --outstanding_;
  }
  window_done_.notify_all();
  return true;
}

void Engine::Impl::release(Channel& channel, const WindowJob& job, const Workbench& bench) {
  if (!bench.samples().empty()) {
    sink_.on_samples(channel.sensor(), bench.samples());
    channel.count_published(bench.samples());
  }
  if (bench.has_report()) release_report(channel, job, bench.report());
  if (job.ends_stream) sink_.on_end(channel.sensor());
}

void Engine::Impl::release_report(Channel& channel, const WindowJob& job, const NoiseReport& report) {
  sink_.on_report(channel.sensor(), report);
  channel.keep_report(report);
  if (!channel.fast_loop) return;
  ModelOrigin origin{job.segment, job.end, report.model_epoch, report.noise_source, {}};
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    origin.noise_floor_radps[axis] = report.axis[axis].noise_floor;
  channel.offer_models(origin);
}

/// True where a window submitted then is not worth denoising any more.
bool Engine::Impl::too_late(double submitted_s) {
  const double now_s = clock_();
  if (now_s >= deadline_s_) hurry_ = true;
  return hurry_ || now_s - submitted_s > options_.max_delay_s;
}

void Engine::Impl::wait_for_progress() {
  // The bound is for time passing without a window being done; a lost wake-up costs no more.
  constexpr auto kLookAgain = std::chrono::milliseconds(2);
  std::unique_lock lock(idle_mutex_);
  window_done_.wait_for(lock, kLookAgain);
}

void Engine::Impl::hurry_after(std::chrono::milliseconds deadline) noexcept {
  const double deadline_s = clock_() + std::chrono::duration<double>(deadline).count();
  deadline_s_ = std::min(deadline_s_.load(), deadline_s);
}

bool Engine::Impl::stop(std::chrono::milliseconds deadline) {
  if (stopping_.exchange(true)) return !hurry_;
  hurry_after(deadline);
  registry_.for_each(options_.max_channels, [this](Channel& channel) { close_segment(channel, false); });
  registry_.for_each(options_.max_channels, [this](Channel& channel) {
    wait_while(channel, [&channel] { return channel.oldest_submission().has_value(); });
  });
  if (scheduler_) scheduler_->stop();
  return !hurry_;
}

void Engine::Impl::wait_idle() {
  std::unique_lock lock(idle_mutex_);
  window_done_.wait(lock, [this] { return outstanding_ == 0; });
}

EngineSnapshot Engine::Impl::snapshot() const {
  EngineSnapshot snapshot;
  {
    // One lock around both: a channel that is forgotten meanwhile is counted once.
    const std::lock_guard lock(homeless_mutex_);
    snapshot.totals = homeless_;
    snapshot.forgotten_channels = forgotten_;
    registry_.for_each(options_.max_channels, [&snapshot](const Channel& channel) {
      snapshot.totals += channel.counts();
      snapshot.silent_channels += channel.silent() ? 1U : 0U;
      ++snapshot.channels;
    });
  }
  {
    const std::lock_guard lock(idle_mutex_);
    snapshot.queued_windows = outstanding_;
  }
  {
    const std::lock_guard lock(health_mutex_);
    snapshot.channels_by_health = by_health_;
    snapshot.health_changes = health_changes_;
    snapshot.overload_step = overload_step_;
  }
  snapshot.workers = options_.workers;
  snapshot.workers_busy = scheduler_ ? scheduler_->busy() : 0;
  for (const auto& bench : benches_) bench->add_times_to(snapshot);
  return snapshot;
}

std::vector<ChannelSnapshot> Engine::Impl::channels(std::size_t limit) const {
  std::vector<ChannelSnapshot> all;
  all.reserve(std::min(limit, registry_.size()));
  registry_.for_each(limit, [&all](const Channel& channel) { all.push_back(channel.snapshot()); });
  return all;
}

void Engine::Impl::visit_channels(std::size_t limit,
                                  const std::function<void(const ChannelSnapshot&)>& visit) const {
  std::optional<ChannelSnapshot> shown;
  const auto take = [&shown](const Channel& channel) { shown = channel.snapshot(); };
  for (std::size_t i = 0; i < limit && registry_.look_at(i, take); ++i) visit(*shown);
}

std::optional<ChannelSnapshot> Engine::Impl::channel(std::string_view sensor) const {
  std::optional<ChannelSnapshot> shown;
  registry_.look_at(sensor, [&shown](const Channel& channel) { shown = channel.snapshot(); });
  return shown;
}

Engine::Engine(EngineOptions options, MethodFactory method, Sink& sink, Clock clock)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(method), sink, std::move(clock))) {}
Engine::~Engine() { impl_->stop(std::chrono::milliseconds{0}); }

std::size_t Engine::push(std::string_view sensor, std::span<const Sample> samples) noexcept {
  return impl_->push(sensor, samples);
}
void Engine::end_of_stream(std::string_view sensor) noexcept { impl_->end_of_stream(sensor); }
void Engine::give_up(std::string_view sensor) noexcept { impl_->give_up(sensor); }
std::optional<PublishedMark> Engine::taken_up_to(std::string_view sensor) const noexcept {
  return impl_->taken_up_to(sensor);
}
void Engine::continue_after(std::string_view sensor, const PublishedMark& mark) noexcept {
  impl_->continue_after(sensor, mark);
}
void Engine::come_again(std::string_view sensor) noexcept { impl_->come_again(sensor); }
void Engine::fall_silent(std::string_view sensor, ChannelState why) noexcept {
  impl_->fall_silent(sensor, why);
}
void Engine::tend() noexcept { impl_->tend(); }
void Engine::judge_health() { impl_->judge_health(); }
void Engine::fit_curves() { impl_->fit_curves(); }
void Engine::hurry_after(std::chrono::milliseconds deadline) noexcept { impl_->hurry_after(deadline); }
bool Engine::stop(std::chrono::milliseconds deadline) { return impl_->stop(deadline); }
void Engine::wait_idle() { impl_->wait_idle(); }
EngineSnapshot Engine::snapshot() const { return impl_->snapshot(); }
std::vector<ChannelSnapshot> Engine::channels(std::size_t limit) const { return impl_->channels(limit); }
void Engine::visit_channels(std::size_t limit,
                            const std::function<void(const ChannelSnapshot&)>& visit) const {
  impl_->visit_channels(limit, visit);
}
std::optional<ChannelSnapshot> Engine::channel(std::string_view sensor) const {
  return impl_->channel(sensor);
}
const EngineOptions& Engine::options() const noexcept { return impl_->options(); }

}  // namespace gyrod::stream
