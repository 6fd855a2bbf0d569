/// The fast loop of model methods inside push(): step, hand-over, release.
#include <algorithm>
#include <cmath>
#include <new>

#include "stream/engine_impl.hpp"

namespace gyrod::stream {
namespace {

/// Windows stay as long as they are down to this part of the rate that made them so: the mean of 64 intervals of stamps that come in bursts is
/// off by a burst.
constexpr double kAsFast = 0.8;

std::uint32_t bit(SampleFlag flag) { return static_cast<std::uint32_t>(flag); }

/// The sample as it leaves, with what the models in use know.
DenoisedSample estimated(const FastLoop& loop, const Sample& sample,
                         const std::array<Estimate, kAxes>& estimate, std::uint32_t flags) {
  DenoisedSample made{.sequence = sample.sequence,
                      .stamp_ns = sample.stamp_ns,
                      .flags = flags,
                      .noise_source = loop.origin().noise_source,
                      .noise_floor_radps = loop.origin().noise_floor_radps,
                      .model_epoch = loop.origin().epoch};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    made.rate_radps[axis] = estimate[axis].rate;
    made.rate_std_radps[axis] = std::sqrt(estimate[axis].variance);
  }
  return made;
}

}  // namespace

void Engine::Impl::step_fast_loop(Channel& channel, const Sample& newest, Place place) {
  FastLoop& loop = *channel.fast_loop;
  if (channel.ring.end() - channel.schedule.segment_begin() == 1) loop.expect_noise(channel.noise);
  const FastLoop::Answer answer = loop.step(newest.rate_radps);
  channel.count_misfits(loop.take_new_misfits());
  std::uint32_t flags = state_flags(channel);
  if (channel.schedule.widened() || channel.models_late) flags |= bit(SampleFlag::kHopWidened);
  if (place == Place::kMeasured) {
    if (realtime_outbox_.size() == realtime_outbox_.capacity()) flush(channel);
    realtime_outbox_.push_back(estimated(loop, newest, answer.realtime, flags));
  }
  const Position position = channel.ring.end() - 1 - static_cast<Position>(options_.lag_samples);
  if (position >= channel.schedule.segment_begin())
    release_estimate(channel, position, answer.denoised, flags);
}

/// What the newest sample, and what is released with it, says of the channel: warming up, misfit.
std::uint32_t Engine::Impl::state_flags(const Channel& channel) const {
  const Position length = channel.ring.end() - channel.schedule.segment_begin();
  std::uint32_t flags =
      length < static_cast<Position>(options_.window_samples) ? bit(SampleFlag::kWarmingUp) : 0U;
  if (channel.fast_loop->misfit()) flags |= bit(SampleFlag::kModelMisfit);
  return flags;
}

/// Waits for the window before this one and takes over its models.
/// @return false where it is late: older models stay in use, and no new window is made (overload step 1)
bool Engine::Impl::adopt_models(Channel& channel) {
  while (const auto submitted = channel.oldest_submission()) {
    if (too_late(*submitted)) {
      if (work(channel, *benches_.back(), false)) continue;  // nobody has begun it: dropped
      const bool in_force = channel.schedule.widened() || channel.models_late;
      if (channel.schedule.widen() || !in_force) channel.count_widened();
      return false;
    }
    flush(channel);
    wait_for_progress();
  }
  const auto origin = channel.take_models();
  if (origin && origin->segment == channel.schedule.segment()) channel.fast_loop->adopt(*origin);
  return true;
}

/// At a hop's end, new models having been taken over if there were any: whether those of the window that ended one step
/// before are not in use, though that window was long enough for models.
bool Engine::Impl::models_are_late(const Channel& channel) const {
  const Position due = channel.ring.end() - channel.schedule.step();
  const Position length = std::min(due - channel.schedule.segment_begin(), channel.schedule.window());
  const auto least = static_cast<Position>(benches_.back()->min_samples());
  return length >= std::max<Position>(least, 1) && channel.fast_loop->origin().window_end != due;
}

/// At a hop's end whose window is due, the models of the one before having been taken over: nobody works on the channel.
void Engine::Impl::follow_rate(Channel& channel) {
  HopSchedule& schedule = channel.schedule;
  const Position end = channel.ring.end();
  const double rate_hz = channel.gate.rate_hz();
  const unsigned most = doublings_at(options_, rate_hz / kAsFast);
  if (doublings_at(options_, rate_hz) > schedule.doublings()) {
    if (schedule.can_double(end) && make_room(channel, schedule.doublings() + 1))
      schedule.double_windows(end);
  } else if (most < schedule.doublings()) {
    schedule.shorten_windows(most, end);
  }
}

/// The only memory that push() takes for a channel that is open, once for each doubling: the channel's, and the first time that of all benches.
/// @return false where there is none: windows stay as they are
bool Engine::Impl::make_room(Channel& channel, unsigned doublings) {
  try {
    for (const auto& bench : benches_) bench->make_room(doublings);
    channel.fast_loop->make_room(options_.window_samples << doublings);
    channel.ring.grow(channel_positions(options_, doublings));
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void Engine::Impl::release_estimate(Channel& channel, Position position,
                                    const std::array<Estimate, kAxes>& estimate, std::uint32_t flags) {
  if (!channel.ring.released(position)) return;
  if (outbox_.size() == outbox_.capacity()) flush(channel);
  outbox_.push_back(estimated(*channel.fast_loop, channel.ring.at(position), estimate, flags));
}

/// The last `lag` samples of a segment, with what look-ahead there is.
void Engine::Impl::release_held(Channel& channel) {
  const Position end = channel.ring.end();
  const Position length = end - channel.schedule.segment_begin();
  const std::uint32_t flags = state_flags(channel) | bit(SampleFlag::kTail);
  for (Position age = std::min(static_cast<Position>(options_.lag_samples), length) - 1; age >= 0; --age) {
    release_estimate(channel, end - 1 - age, channel.fast_loop->held(static_cast<std::size_t>(age)), flags);
  }
  flush(channel);
  channel.fast_loop->reset();
  channel.models_late = false;
}

/// Hands over what this call of push() has made so far; the newest first, nobody waits for the others as much.
void Engine::Impl::flush(Channel& channel) {
  if (!realtime_outbox_.empty()) {
    sink_.on_realtime(channel.sensor(), realtime_outbox_);
    channel.count_realtime(realtime_outbox_.size());
    realtime_outbox_.clear();
  }
  if (outbox_.empty()) return;
  sink_.on_samples(channel.sensor(), outbox_);
  channel.count_published(outbox_);
  outbox_.clear();
}

}  // namespace gyrod::stream
