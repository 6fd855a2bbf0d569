#include "live/noise_history.hpp"

#include <algorithm>

namespace gyrod::live {

void NoiseHistory::note(const stream::ChannelSnapshot& sensor) {
  const std::lock_guard lock(mutex_);
  Ring& ring = sensors_.try_emplace(sensor.sensor).first->second;
  Axes& point = ring.points[ring.noted++ % kPoints];
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    point[axis] = static_cast<float>(sensor.last_report.axis[axis].noise_floor);
  ring.round = round_;
}

void NoiseHistory::end_round() {
  const std::lock_guard lock(mutex_);
  std::erase_if(sensors_, [this](const auto& entry) { return entry.second.round != round_; });
  ++round_;
}

std::vector<NoiseHistory::Axes> NoiseHistory::of(std::string_view sensor) const {
  const std::lock_guard lock(mutex_);
  const auto found = sensors_.find(sensor);
  if (found == sensors_.end()) return {};
  const Ring& ring = found->second;
  const std::size_t held = std::min(ring.noted, kPoints);
  std::vector<Axes> points;
  points.reserve(held);
  for (std::size_t i = ring.noted - held; i < ring.noted; ++i) points.push_back(ring.points[i % kPoints]);
  return points;
}

std::uint64_t NoiseHistory::rounds() const {
  const std::lock_guard lock(mutex_);
  return round_;
}

}  // namespace gyrod::live
