#include "app/understudy.hpp"

#include <algorithm>
#include <iterator>

namespace gyrod::app {

void Understudy::let_go(Followed& followed, std::int64_t now_ns) {
  while (!followed.samples.empty() && now_ns - followed.samples.front().came_ns > kKeptNs) {
    followed.samples.pop_front();
    --samples_;
  }
}

/// A mark tells nothing of what the sensor sent before it began anew.
bool Understudy::begins_anew(const Followed& followed, const stream::Sample& sample) noexcept {
  if (followed.samples.empty()) return false;
  const stream::Sample& last = followed.samples.back().sample;
  return sample.sequence < last.sequence || sample.stamp_ns < last.stamp_ns;
}

void Understudy::clear(Followed& followed) noexcept {
  samples_ -= followed.samples.size();
  followed = {};
}

void Understudy::make_room(std::int64_t now_ns) {
  constexpr std::int64_t kPauseNs = 1'000'000'000;
  if (made_room_ns_ && now_ns - *made_room_ns_ < kPauseNs) return;
  made_room_ns_ = now_ns;
  for (auto& [sensor, followed] : followed_) let_go(followed, now_ns);
  std::erase_if(followed_, [](const auto& entry) { return entry.second.samples.empty(); });
}

void Understudy::follow(std::string_view sensor, std::span<const stream::Sample> samples,
                        std::int64_t now_ns) {
  const bool full = samples_ + samples.size() > kMostSamples || followed_.size() == kMostSensors;
  if (full) make_room(now_ns);
  auto found = followed_.find(sensor);
  if (found == followed_.end()) {
    if (followed_.size() == kMostSensors) return;
    found = followed_.emplace(sensor, Followed{}).first;
  }
  Followed& followed = found->second;
  let_go(followed, now_ns);
  for (const stream::Sample& sample : samples) {
    if (followed.ended || begins_anew(followed, sample)) clear(followed);
    if (samples_ == kMostSamples) {
      // Its own oldest, as a hole in the middle would be worse.
      if (followed.samples.empty()) return;
      followed.samples.pop_front();
      --samples_;
    }
    followed.samples.push_back({sample, now_ns});
    ++samples_;
  }
}

void Understudy::end(std::string_view sensor) {
  if (const auto found = followed_.find(sensor); found != followed_.end()) found->second.ended = true;
}

void Understudy::note(std::span<const bus::GivenUp> given, std::int64_t now_ns) {
  std::erase_if(marks_, [now_ns](const auto& old) { return now_ns - old.second.told_ns > kMarkHoldsNs; });
  for (const bus::GivenUp& one : given) {
    if (marks_.size() == kMostSensors) return;
    const auto [found, is_new] = marks_.try_emplace(one.sensor, Mark{one.taken, now_ns});
    // Two daemons that gave it up one after the other may be heard the other way round.
    if (is_new || found->second.mark.stamp_ns <= one.taken.stamp_ns) found->second = {one.taken, now_ns};
  }
}

std::vector<Understudy::Part> Understudy::take(const std::function<bool(std::string_view)>& now_served,
                                               std::int64_t now_ns) {
  std::vector<Part> parts;
  for (auto& [sensor, followed] : followed_) {
    let_go(followed, now_ns);
    if (followed.samples.empty() || !now_served(sensor)) continue;
    Part& part = parts.emplace_back(Part{sensor, {}, followed.ended});
    std::ranges::transform(followed.samples, std::back_inserter(part.samples), &Kept::sample);
  }
  drop(now_served);
  return parts;
}

void Understudy::drop(const std::function<bool(std::string_view)>& now_served) {
  std::erase_if(followed_, [&](const auto& entry) {
    const bool goes = entry.second.samples.empty() || now_served(entry.first);
    if (goes) samples_ -= entry.second.samples.size();
    return goes;
  });
}

void Understudy::forget_mark(std::string_view sensor) {
  if (const auto found = marks_.find(sensor); found != marks_.end()) marks_.erase(found);
}

std::optional<stream::PublishedMark> Understudy::take_mark(std::string_view sensor, std::int64_t now_ns) {
  const auto found = marks_.find(sensor);
  if (found == marks_.end()) return std::nullopt;
  const Mark mark = found->second;
  marks_.erase(found);
  if (now_ns - mark.told_ns > kMarkHoldsNs) return std::nullopt;
  return mark.mark;
}

}  // namespace gyrod::app
