#include "app/engine_feed.hpp"

#include <chrono>
#include <thread>

#include <spdlog/spdlog.h>

namespace gyrod::app {
namespace {

/// Sensors that were lost together come back within this time.
constexpr std::chrono::seconds kTogether{10};

std::int64_t now_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

std::size_t EngineInlet::push(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  const bool served = rule_.serves(sensor);
  if (!served && !samples.empty() && holds(rule_.own, sensor))
    succession_.watch(sensor, samples.back().stamp_ns, now_ns());
  const std::size_t foreign = served ? served_before(sensor, samples, now_ns()) : samples.size();
  if (foreign > 0) foreign_.fetch_add(foreign, std::memory_order_relaxed);
  if (foreign == samples.size()) return 0;
  tap_.on_raw(sensor, samples.subspan(foreign));
  return engine_.push(sensor, samples.subspan(foreign));
}

/// Samples at the front that the daemon before this one may have served.
std::size_t EngineInlet::served_before(std::string_view sensor, std::span<const stream::Sample> samples,
                                       std::int64_t now) noexcept {
  std::size_t count = 0;
  while (count < samples.size() && succession_.may_have_been_served(sensor, samples[count].stamp_ns, now))
    ++count;
  return count;
}

void EngineInlet::end(std::string_view sensor) noexcept {
  const std::lock_guard lock(mutex_);
  engine_.end_of_stream(sensor);
}

void EngineInlet::come_again(std::string_view sensor) noexcept {
  const std::lock_guard lock(mutex_);
  engine_.come_again(sensor);
}

void EngineInlet::fall_silent(std::string_view sensor, stream::ChannelState why) noexcept {
  const std::lock_guard lock(mutex_);
  engine_.fall_silent(sensor, why);
}

void EngineInlet::tend() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) engine_.tend();
}

void EngineInlet::serve(const fleet::ServingRule& rule) noexcept {
  const std::lock_guard lock(mutex_);
  rule_ = rule;
  succession_.change(now_ns(), [this](std::string_view sensor) { return rule_.serves(sensor); });
  for (const stream::ChannelSnapshot& channel : engine_.channels(engine_.options().max_channels)) {
    if (!rule_.serves(channel.sensor)) engine_.end_of_stream(channel.sensor);
  }
}

void FeedFromBus::on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  inlet_.push(imu_topics_.claims(sensor) ? std::string_view{} : sensor, samples);
}

void FeedFromBus::on_end(std::string_view sensor) noexcept {
  if (!imu_topics_.claims(sensor)) inlet_.end(sensor);
}

/// What leaves before a reader is found is not its own. Sensors that come back together wait once.
void FeedFromBus::on_return(std::string_view sensor) noexcept {
  if (imu_topics_.claims(sensor)) return;
  const auto now = std::chrono::steady_clock::now();
  if (discovery_.count() > 0 && (!waited_ || now - *waited_ > kTogether)) {
    std::this_thread::sleep_for(discovery_);
    waited_ = std::chrono::steady_clock::now();
  }
  inlet_.come_again(sensor);
}

void FeedFromBus::on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept {
  if (!imu_topics_.claims(sensor)) inlet_.fall_silent(sensor, why);
}

bool FeedFromRos2::on_sample(std::string_view sensor, const stream::Sample& sample) noexcept {
  return inlet_.push(sensor, {&sample, 1}) == 1;
}

void FeedFromRos2::on_end(std::string_view sensor) noexcept { inlet_.end(sensor); }

void FeedFromRos2::on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept {
  inlet_.fall_silent(sensor, why);
}

void FeedFromRos2::on_topic(std::string_view topic, const ros2::Outputs& outputs) noexcept {
  spdlog::info("ROS 2: reads {}, writes {}", topic, outputs.denoised);
}

void FeedFromRos2::on_refused_topic(std::string_view reason) noexcept { spdlog::warn("cannot {}", reason); }

}  // namespace gyrod::app
