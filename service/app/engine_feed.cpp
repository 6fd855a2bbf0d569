#include "app/engine_feed.hpp"

#include <spdlog/spdlog.h>

namespace gyrod::app {

std::size_t EngineInlet::push(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  return engine_.push(sensor, samples);
}

void EngineInlet::end(std::string_view sensor) noexcept {
  const std::lock_guard lock(mutex_);
  engine_.end_of_stream(sensor);
}

void EngineInlet::tend() noexcept {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (lock.owns_lock()) engine_.tend();
}

void FeedFromBus::on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  inlet_.push(imu_topics_.claims(sensor) ? std::string_view{} : sensor, samples);
}

void FeedFromBus::on_end(std::string_view sensor) noexcept {
  if (!imu_topics_.claims(sensor)) inlet_.end(sensor);
}

bool FeedFromRos2::on_sample(std::string_view sensor, const stream::Sample& sample) noexcept {
  return inlet_.push(sensor, {&sample, 1}) == 1;
}

void FeedFromRos2::on_end(std::string_view sensor) noexcept { inlet_.end(sensor); }

void FeedFromRos2::on_topic(std::string_view topic, const ros2::Outputs& outputs) noexcept {
  spdlog::info("ROS 2: reads {}, writes {}", topic, outputs.denoised);
}

void FeedFromRos2::on_refused_topic(std::string_view reason) noexcept { spdlog::warn("cannot {}", reason); }

}  // namespace gyrod::app
