/// The fast loop of model methods inside push(): step, hand-over, release.
#include <algorithm>

#include "stream/engine_impl.hpp"

namespace gyrod::stream {
namespace {

std::uint32_t bit(SampleFlag flag) { return static_cast<std::uint32_t>(flag); }

}  // namespace

void Engine::Impl::step_fast_loop(Channel& channel, const Sample& newest) {
  const auto estimate = channel.fast_loop->step(newest.rate_radps);
  const Position position = channel.ring.end() - 1 - static_cast<Position>(options_.lag_samples);
  if (position < channel.schedule.segment_begin()) return;
  const Position length = channel.ring.end() - channel.schedule.segment_begin();
  std::uint32_t flags =
      length < static_cast<Position>(options_.window_samples) ? bit(SampleFlag::kWarmingUp) : 0U;
  if (channel.schedule.widened()) flags |= bit(SampleFlag::kHopWidened);
  release_estimate(channel, position, estimate, flags);
}

/// Waits for the window before this one and takes over its models.
/// @return false where it is late: older models stay in use, and no new window is made (overload step 1)
bool Engine::Impl::adopt_models(Channel& channel) {
  while (const auto submitted = channel.oldest_submission()) {
    if (too_late(*submitted)) {
      if (work(channel, *benches_.back(), false)) continue;  // nobody has begun it: dropped
      if (channel.schedule.widen()) channel.count_widened();
      return false;
    }
    wait_for_progress();
  }
  const auto origin = channel.take_models();
  if (origin && origin->segment == channel.schedule.segment()) channel.fast_loop->adopt(*origin);
  return true;
}

void Engine::Impl::release_estimate(Channel& channel, Position position,
                                    const std::array<double, kAxes>& estimate, std::uint32_t flags) {
  if (!channel.ring.measured(position)) return;
  const Sample sample = channel.ring.at(position);
  const ModelOrigin& origin = channel.fast_loop->origin();
  if (outbox_.size() == outbox_.capacity()) flush_outbox(channel);
  outbox_.push_back({.sequence = sample.sequence,
                     .stamp_ns = sample.stamp_ns,
                     .rate_radps = estimate,
                     .flags = flags,
                     .noise_source = origin.noise_source,
                     .noise_floor_radps = origin.noise_floor_radps,
                     .model_epoch = origin.epoch});
}

/// The last `lag` samples of a segment, with what look-ahead there is.
void Engine::Impl::release_held(Channel& channel) {
  const Position end = channel.ring.end();
  const Position length = end - channel.schedule.segment_begin();
  std::uint32_t flags = bit(SampleFlag::kTail);
  if (length < static_cast<Position>(options_.window_samples)) flags |= bit(SampleFlag::kWarmingUp);
  for (Position age = std::min(static_cast<Position>(options_.lag_samples), length) - 1; age >= 0; --age) {
    release_estimate(channel, end - 1 - age, channel.fast_loop->held(static_cast<std::size_t>(age)), flags);
  }
  flush_outbox(channel);
  channel.fast_loop->reset();
}

void Engine::Impl::flush_outbox(Channel& channel) {
  if (outbox_.empty()) return;
  sink_.on_samples(channel.sensor(), outbox_);
  channel.count_published(outbox_);
  outbox_.clear();
}

}  // namespace gyrod::stream
