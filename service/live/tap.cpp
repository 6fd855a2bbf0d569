#include "live/tap.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <thread>
#include <utility>

namespace gyrod::live {
namespace {

/// Never 0.
std::uint64_t hash_of(std::string_view sensor) noexcept { return std::hash<std::string_view>{}(sensor) | 1U; }

std::size_t capacity_for(double sample_rate_hz) noexcept {
  constexpr double kMargin = 1.1;
  const double samples = sample_rate_hz * Tap::kMostSeconds * kMargin;
  const auto most = static_cast<double>(Tap::kMostSamples);
  if (!(samples > 0.0) || samples >= most) return Tap::kMostSamples;
  return std::bit_ceil(static_cast<std::size_t>(samples) + 1);
}

}  // namespace

std::shared_ptr<const Watched> Tap::look(std::string_view sensor, double sample_rate_hz, double now_s) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(places_, sensor, &Place::sensor);
  if (found != places_.end()) {
    found->asked_s = now_s;
    return found->watched;
  }
  const auto free = std::ranges::find_if(places_, [](const Place& place) { return !place.watched; });
  if (free == places_.end()) return nullptr;
  change(*free, sensor, std::make_shared<Watched>(capacity_for(sample_rate_hz), now_s));
  free->asked_s = now_s;
  looked_at_.fetch_add(1, std::memory_order_relaxed);
  return free->watched;
}

void Tap::tidy(double now_s) {
  const std::lock_guard lock(mutex_);
  for (Place& place : places_) {
    if (!place.watched || now_s - place.asked_s < kLingerS) continue;
    looked_at_.fetch_sub(1, std::memory_order_relaxed);
    change(place, "", nullptr);
  }
}

/// Waits for the samples' threads, which hold `busy` for some copying at the most.
void Tap::change(Place& place, std::string_view sensor, std::shared_ptr<Watched> watched) noexcept {
  std::string name(sensor);
  for (std::atomic_flag& busy : place.busy) {
    while (busy.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  place.sensor.swap(name);
  place.watched.swap(watched);
  place.hash.store(place.watched ? hash_of(sensor) : 0, std::memory_order_relaxed);
  for (std::atomic_flag& busy : place.busy) busy.clear(std::memory_order_release);
}

/// Calls add(Watched&) if the sensor is looked at, and nobody is about to change that.
template <class Add>
void Tap::with(Way way, std::string_view sensor, const Add& add) noexcept {
  if (looked_at_.load(std::memory_order_relaxed) == 0) return;
  const std::uint64_t hash = hash_of(sensor);
  for (Place& place : places_) {
    if (place.hash.load(std::memory_order_relaxed) != hash) continue;
    if (place.busy[way].test_and_set(std::memory_order_acquire)) continue;
    if (place.watched && place.sensor == sensor) add(*place.watched);
    place.busy[way].clear(std::memory_order_release);
  }
}

void Tap::on_raw(std::string_view sensor, std::span<const stream::Sample> samples) noexcept {
  with(kRaw, sensor, [samples](Watched& watched) {
    for (const stream::Sample& sample : samples) watched.raw.add(sample.stamp_ns, sample.rate_radps);
  });
}

void Tap::on_denoised(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
  with(kDenoised, sensor, [samples](Watched& watched) {
    for (const stream::DenoisedSample& sample : samples)
      watched.denoised.add(sample.stamp_ns, sample.rate_radps);
  });
}

void Tap::on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept {
  if (!report.at_rest) return;
  with(kReports, sensor,
       [&report](Watched& watched) { watched.rests.note(report.last_stamp_ns, *report.at_rest); });
}

}  // namespace gyrod::live
