#include "app/release_to_bus.hpp"

#include <algorithm>
#include <new>
#include <string>

#include <spdlog/spdlog.h>

#include "app/wall_clock.hpp"

namespace gyrod::app {
namespace {

/// One line a sensor, also where axes change one by one; warming up is told by metrics alone.
void log_health(std::string_view sensor, const stream::SensorHealth& before,
                const stream::SensorHealth& now) noexcept {
  if (before.state == now.state) return;
  const bool troubled = now.state > stream::Health::kWarmingUp;
  const bool was_troubled = before.state > stream::Health::kWarmingUp;
  if (!troubled && !was_troubled) return;
  const auto worst = std::ranges::find(now.axis, now.state, &stream::AxisHealth::state);
  const char* axis = stream::kAxisNames[static_cast<std::size_t>(worst - now.axis.begin())];
  try {
    const std::string evidence = live::evidence_words(*worst);
    spdlog::log(troubled ? spdlog::level::warn : spdlog::level::info, "{} is {}, before {}{}", sensor,
                stream::name_of(now.state), stream::name_of(before.state),
                evidence.empty() ? "" : " (axis " + std::string(axis) + ": " + evidence + ")");
  } catch (const std::bad_alloc&) {
    return;  // a line less
  }
}

/// An event of what becomes of a sensor.
void tell(live::Live& live, std::string_view sensor, const char* what) noexcept {
  try {
    live.events.add(seconds_since_1970(), sensor, std::string(sensor) + " " + what + ".");
  } catch (const std::bad_alloc&) {
    return;  // an event less
  }
}

/// Time for readers to take one cache of messages: 50 000 samples a second at the default depth.
constexpr std::chrono::milliseconds kBreath{20};

}  // namespace

/// All at once, or, while there is patience, no more at a time than the writers keep.
template <class Publish>
void ReleaseToBus::in_parts(std::span<const stream::DenoisedSample> samples,
                            const Publish& publish) noexcept {
  while (patience_ns_ > 0 && !samples.empty()) {
    const auto part = samples.first(std::min(samples.size(), depth_));
    let_readers_catch_up(part.size());
    publish(part);
    samples = samples.subspan(part.size());
  }
  if (!samples.empty()) publish(samples);
}

void ReleaseToBus::on_samples(std::string_view sensor,
                              std::span<const stream::DenoisedSample> samples) noexcept {
  live_.tap.on_denoised(sensor, samples);
  if (imu_topics_.publish(sensor, samples)) return;
  if (standby_ != nullptr) return standby_->release(sensor, samples);
  publish(sensor, samples);
}

void ReleaseToBus::on_realtime(std::string_view sensor,
                               std::span<const stream::DenoisedSample> samples) noexcept {
  if (imu_topics_.publish_realtime(sensor, samples)) return;
  if (standby_ != nullptr) return standby_->release_realtime(sensor, samples);
  publish_realtime(sensor, samples);
}

void ReleaseToBus::publish(std::string_view sensor,
                           std::span<const stream::DenoisedSample> samples) noexcept {
  in_parts(samples, [&](const auto& part) { publisher_.publish(sensor, part); });
  if (!samples.empty()) published_.note(sensor, samples.back());
}

void ReleaseToBus::publish_realtime(std::string_view sensor,
                                    std::span<const stream::DenoisedSample> samples) noexcept {
  in_parts(samples, [&](const auto& part) { publisher_.publish_realtime(sensor, part); });
}

void ReleaseToBus::end(std::string_view sensor) noexcept {
  publisher_.unregister_sensor(sensor);
  published_.forget(sensor);
}

void ReleaseToBus::on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept {
  live_.tap.on_report(sensor, report);
  if (standby_ == nullptr || standby_->publishes(sensor) || imu_topics_.publishes(sensor))
    publisher_.publish_report(sensor, report);
}

void ReleaseToBus::on_end(std::string_view sensor) noexcept {
  tell(live_, sensor, "has ended");
  if (standby_ != nullptr) return standby_->end(sensor);
  end(sensor);
}

void ReleaseToBus::on_health(std::string_view sensor, const stream::SensorHealth& before,
                             const stream::SensorHealth& now) noexcept {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  publisher_.publish_health(sensor, before, now,
                            std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count());
  log_health(sensor, before, now);
  try {
    live_.events.add_health(std::chrono::duration<double>(since_epoch).count(), sensor, before, now);
  } catch (const std::bad_alloc&) {
    return;  // the log above and the topic have it
  }
}

void ReleaseToBus::on_forgotten(std::string_view sensor) noexcept {
  publisher_.unregister_health(sensor);
  tell(live_, sensor, "is forgotten: it has sent nothing for long");
}

/// Before so many more samples: gives readers the time to take or to ask again for what the writers are about
/// to let go. Their confirmation is asked for by a timer of the middleware, not at once, so it is not waited
/// for to the end.
void ReleaseToBus::let_readers_catch_up(std::size_t samples) noexcept {
  if ((unconfirmed_ += samples) <= depth_) return;
  unconfirmed_ = samples;
  const auto begin = std::chrono::steady_clock::now();
  publisher_.wait_for_acknowledgements(kBreath);
  patience_ns_ -= std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace gyrod::app
