/// What push() does: judge, append, cut into windows.
#include <algorithm>
#include <new>
#include <string>

#include "core/signal/interpolation.hpp"
#include "stream/engine_impl.hpp"

namespace gyrod::stream {

std::size_t Engine::Impl::push(std::string_view sensor, std::span<const Sample> samples) noexcept {
  RejectReason refusal{};
  Channel* channel = channel_for(sensor, refusal);
  if (channel == nullptr) {
    refuse(samples.size(), refusal);
    return 0;
  }
  channel->hear(clock_());
  std::size_t accepted = 0;
  for (const Sample& sample : samples) accepted += take(*channel, sample) ? 1U : 0U;
  flush(*channel);
  listen_again();
  channel->show_health();
  return accepted;
}

/// The sensor's channel, opened if it is new; none, and why, where its samples are refused.
Channel* Engine::Impl::channel_for(std::string_view sensor, RejectReason& refusal) {
  refusal = RejectReason::kShuttingDown;
  if (stopping_) return nullptr;
  if (Channel* known = registry_.find(sensor)) return known;
  refusal = RejectReason::kBadSensorId;
  if (!is_valid_sensor_id(sensor)) return nullptr;
  refusal = RejectReason::kTooManyChannels;
  if (registry_.full()) return nullptr;
  try {
    const auto* models = std::get_if<ModelMethodFactory>(&method_);
    return &registry_.open(std::make_unique<Channel>(std::string{sensor}, options_, models));
  } catch (const std::bad_alloc&) {
    return nullptr;  // no memory for one more channel: the ones that are open live on
  }
}

void Engine::Impl::refuse(std::size_t samples, RejectReason reason) {
  const std::lock_guard lock(homeless_mutex_);
  homeless_.received += samples;
  homeless_.rejected[static_cast<std::size_t>(reason)] += samples;
}

/// @return false where the sample was refused, or is not to leave
bool Engine::Impl::take(Channel& channel, const Sample& sample) {
  channel.count_received();
  const Verdict verdict = channel.gate.judge(sample);
  if (verdict.kind == Verdict::Kind::kRefuse) {
    channel.count_rejected(verdict.reason);
    channel.watch.lose(1);
    return false;
  }
  channel.count_accepted(verdict);
  // What a sensor did not send while it was silent is not a loss.
  if (!channel.asleep) channel.watch.lose(verdict.missing);
  if (verdict.kind == Verdict::Kind::kRestart) channel.end_history();
  if (channel.asleep) {
    channel.asleep = false;
  } else if (verdict.kind == Verdict::Kind::kAccept) {
    bridge(channel, sample, verdict.bridge);
  } else {
    close_segment(channel, false);
  }
  const bool history = channel.is_history(sample);
  if (history) channel.count_rejected(RejectReason::kHistory);
  append(channel, sample, history ? Place::kHistory : Place::kMeasured);
  return !history;
}

void Engine::Impl::bridge(Channel& channel, const Sample& next, std::uint64_t count) {
  if (count == 0) return;
  const Sample left = channel.ring.at(channel.ring.end() - 1);
  for (std::uint64_t step = 0; step < count; ++step) {
    Sample filled = left;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      filled.rate_radps[axis] = core::bridge(left.rate_radps[axis], next.rate_radps[axis], step, count);
    }
    append(channel, filled, Place::kBridged);
    channel.count_bridged();
  }
}

void Engine::Impl::append(Channel& channel, const Sample& sample, Place place) {
  wait_while(channel, [&channel] { return !channel.has_room(); });
  channel.append(sample, place);
  if (channel.fast_loop) step_fast_loop(channel, sample, place);
  if (channel.schedule.at_boundary(channel.ring.end())) hop(channel);
}

/// A whole number of hops is full: makes the window that is due.
void Engine::Impl::hop(Channel& channel) {
  adjust_hop(channel);
  const bool due = channel.schedule.due(channel.ring.end());
  // A model method's fast loop takes over the models of the window before, and waits for them: that fixes the
  // moment.
  const bool late = channel.fast_loop && due && !adopt_models(channel);
  if (channel.fast_loop) channel.models_late = models_are_late(channel);
  if (!due || late) return;
  if (channel.fast_loop) follow_rate(channel);
  submit(channel, channel.schedule.take(channel.ring.end()));
}

/// Overload step 1: windows that wait too long come less often.
void Engine::Impl::adjust_hop(Channel& channel) {
  const auto oldest = channel.oldest_submission();
  if (!oldest) {
    channel.schedule.narrow();
  } else if (clock_() - *oldest > 0.5 * options_.max_delay_s && channel.schedule.widen()) {
    channel.count_widened();
  }
}

/// Releases what the segment holds; the next sample begins a new window.
void Engine::Impl::close_segment(Channel& channel, bool ends_stream) {
  if (channel.fast_loop) release_held(channel);
  WindowJob tail = channel.schedule.close(channel.ring.end());
  if (channel.fast_loop) tail.begin = tail.end;
  tail.ends_stream = ends_stream;
  if (tail.begin < tail.end || ends_stream) submit(channel, tail);
  if (channel.learner) channel.learner->reset_segment();
  channel.watch.begin_stretch();
  channel.show_health();
}

/// Where push() waited, nobody was heard: silences count from here.
void Engine::Impl::listen_again() {
  if (waits_.exchange(false)) deaf_until_s_ = clock_();
}

void Engine::Impl::end_of_stream(std::string_view sensor) noexcept {
  Channel* channel = registry_.find(sensor);
  if (channel == nullptr || stopping_ || !channel->gate.is_open()) return;
  channel->lose_sight(clock_());
  close_segment(*channel, true);
  channel->gate.reopen();
  channel->end_history();
  channel->asleep = false;
  channel->end();
  channel->watch.end();
  channel->show_health();
  listen_again();
  if (!channel->fast_loop) return;
  // A worker tells the end; the fast loop must not release samples of the next stream before that.
  wait_while(*channel, [channel] { return channel->oldest_submission().has_value(); });
}

void Engine::Impl::come_again(std::string_view sensor) noexcept {
  Channel* channel = registry_.find(sensor);
  if (channel == nullptr || stopping_) return;
  if (channel->gate.is_open()) {
    channel->lose_sight(clock_());
    close_segment(*channel, false);
    channel->gate.reopen();
    listen_again();
  }
  channel->expect_history();
}

void Engine::Impl::give_up(std::string_view sensor) noexcept {
  end_of_stream(sensor);
  Channel* channel = registry_.find(sensor);
  if (channel == nullptr) return;
  channel->end_history();
  channel->gate.forget();
}

std::optional<PublishedMark> Engine::Impl::taken_up_to(std::string_view sensor) const noexcept {
  const Channel* channel = registry_.find(sensor);
  return channel != nullptr ? channel->taken_up_to() : std::nullopt;
}

void Engine::Impl::continue_after(std::string_view sensor, const PublishedMark& mark) noexcept {
  RejectReason refusal{};
  if (Channel* channel = channel_for(sensor, refusal)) channel->continue_after(mark);
}

void Engine::Impl::tend() noexcept {
  if (stopping_) return;
  const double now_s = clock_();
  if (options_.silent_after_s > 0.0) {
    registry_.for_each(options_.max_channels, [this, now_s](Channel& channel) {
      const bool quiet = now_s - channel.heard_s() > options_.silent_after_s;
      if (quiet && !channel.silent() && channel.gate.is_open()) fall_silent(channel, ChannelState::kSilent);
    });
  }
  if (options_.forget_after_s > 0.0) forget(now_s);
}

void Engine::Impl::fall_silent(std::string_view sensor, ChannelState why) noexcept {
  Channel* channel = registry_.find(sensor);
  if (channel == nullptr || stopping_ || channel->silent()) return;
  if (channel->gate.is_open()) {
    fall_silent(*channel, why);
  } else {
    channel->end(why);
  }
}

/// The gate stays open: it tells what was missing when the sensor is back.
void Engine::Impl::fall_silent(Channel& channel, ChannelState why) {
  channel.note_silence(clock_());
  close_segment(channel, false);
  channel.asleep = true;
  channel.gate.expect_restart();
  channel.fall_silent(why);
}

void Engine::Impl::forget(double now_s) {
  std::vector<std::unique_ptr<Channel>> forgotten;
  {
    const std::lock_guard lock(homeless_mutex_);
    forgotten = registry_.remove_if([&](const Channel& channel) {
      const bool over = channel.silent() || !channel.gate.is_open();
      return over && now_s - channel.heard_s() > options_.forget_after_s && channel.idle();
    });
    for (const auto& channel : forgotten) homeless_ += channel->counts();
    forgotten_ += forgotten.size();
  }
  for (const auto& channel : forgotten) {
    if (channel->gate.is_open()) sink_.on_end(channel->sensor());
    sink_.on_forgotten(channel->sensor());
  }
}

}  // namespace gyrod::stream
