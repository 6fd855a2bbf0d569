#include "app/engine_feed.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>
#include <utility>

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

bus::Fate EngineInlet::push(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  if (rule_.serves(sensor)) return take(sensor, samples);
  foreign_.fetch_add(samples.size(), std::memory_order_relaxed);
  if (samples.empty() || !holds(rule_.own, sensor)) return bus::Fate::kDoesNot;
  const std::int64_t now = now_ns();
  succession_.watch(sensor, samples.back().stamp_ns, now);
  understudy_.follow(sensor, samples, now);
  return bus::Fate::kMayLeave;
}

/// Of a sensor that is served here.
bus::Fate EngineInlet::take(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  if (understudy_.has_marks()) {
    if (const auto mark = understudy_.take_mark(sensor, now_ns())) engine_.continue_after(sensor, *mark);
  }
  const std::size_t before = served_before(sensor, samples, now_ns());
  if (before > 0) foreign_.fetch_add(before, std::memory_order_relaxed);
  if (before == samples.size()) return bus::Fate::kDoesNot;
  tap_.on_raw(sensor, samples.subspan(before));
  return engine_.push(sensor, samples.subspan(before)) > 0 ? bus::Fate::kLeaves : bus::Fate::kDoesNot;
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
  if (rule_.serves(sensor)) {
    understudy_.forget_mark(sensor);
  } else {
    understudy_.end(sensor);
  }
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

std::vector<bus::GivenUp> EngineInlet::serve(const fleet::ServingRule& rule, bool told) noexcept {
  const std::lock_guard lock(mutex_);
  std::vector<bus::GivenUp> given = given_up_by(rule);
  const fleet::ServingRule before = std::exchange(rule_, rule);
  const auto is_served = [this](std::string_view sensor) { return rule_.serves(sensor); };
  const auto is_new = [&](std::string_view sensor) { return is_served(sensor) && !before.serves(sensor); };
  const std::int64_t now = now_ns();
  if (told) succession_.settle(is_new);
  succession_.change(now, is_served);
  if (told) {
    for (const Understudy::Part& part : understudy_.take(is_new, now)) {
      take(part.sensor, part.samples);
      if (part.ended) engine_.end_of_stream(part.sensor);
    }
  } else {
    understudy_.drop(is_new);
  }
  for (const bus::GivenUp& one : given) engine_.give_up(one.sensor);
  return given;
}

std::vector<bus::GivenUp> EngineInlet::served() noexcept {
  const std::lock_guard lock(mutex_);
  return given_up_by({.own = rule_.own});
}

/// What is served now and would not be by that rule.
std::vector<bus::GivenUp> EngineInlet::given_up_by(const fleet::ServingRule& rule) const {
  std::vector<bus::GivenUp> given;
  engine_.visit_channels(engine_.options().max_channels, [&](const stream::ChannelSnapshot& channel) {
    if (!rule_.serves(channel.sensor) || rule.serves(channel.sensor)) return;
    if (const auto taken = engine_.taken_up_to(channel.sensor)) given.push_back({channel.sensor, *taken});
  });
  return given;
}

void EngineInlet::heed(std::span<const bus::GivenUp> given) noexcept {
  const std::lock_guard lock(mutex_);
  // Of what is served here others tell nothing that matters: they served the same, as a twin does.
  std::vector<bus::GivenUp> of_others;
  std::ranges::copy_if(given, std::back_inserter(of_others),
                       [this](const bus::GivenUp& one) { return !rule_.serves(one.sensor); });
  understudy_.note(of_others, now_ns());
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

bus::Fate FeedFromRos2::on_sample(std::string_view sensor, const stream::Sample& sample) noexcept {
  return inlet_.push(sensor, {&sample, 1});
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
