#include "live/recent.hpp"

#include <algorithm>

namespace gyrod::live {
namespace {

/// What has come since.
stream::TimeHistogram difference(const stream::TimeHistogram& now, const stream::TimeHistogram& before) {
  stream::TimeHistogram made;
  for (std::size_t i = 0; i < made.buckets.size(); ++i) made.buckets[i] = now.buckets[i] - before.buckets[i];
  made.count = now.count - before.count;
  made.sum_s = now.sum_s - before.sum_s;
  return made;
}

}  // namespace

std::optional<double> quantile(const stream::TimeHistogram& times, double share) noexcept {
  const auto& bounds = stream::TimeHistogram::kUpperBoundsS;
  std::uint64_t all = 0;
  for (const std::uint64_t bucket : times.buckets) all += bucket;
  if (all == 0) return std::nullopt;
  const double rank = share * static_cast<double>(all);
  double below = 0.0;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto here = static_cast<double>(times.buckets[i]);
    if (here > 0.0 && below + here >= rank) {
      const double lower = i == 0 ? 0.0 : bounds[i - 1];
      return lower + (bounds[i] - lower) * std::max(0.0, rank - below) / here;
    }
    below += here;
  }
  return bounds.back();
}

void Recent::note(double now_s, const stream::EngineSnapshot& engine) {
  const std::lock_guard lock(mutex_);
  notes_[noted_ % kNotes] = {.time_s = now_s,
                             .received = engine.totals.received,
                             .windows = engine.totals.windows,
                             .window_time = engine.window_time,
                             .added_latency = engine.added_latency};
  ++noted_;
}

Recent::Figures Recent::figures() const {
  const std::lock_guard lock(mutex_);
  Figures figures;
  if (noted_ < 2) return figures;
  const std::size_t held = std::min(noted_, kNotes) - 1;
  const Note& now = back(0);
  std::size_t notes = 1;
  while (notes < held && now.time_s - back(notes).time_s < kRateWindowS) ++notes;
  const Note& then = back(notes);
  if (const double seconds = now.time_s - then.time_s; seconds > 0.0) {
    figures.samples_per_s = static_cast<double>(now.received - then.received) / seconds;
    figures.windows_per_s = static_cast<double>(now.windows - then.windows) / seconds;
  }
  figures.window_time = difference(now.window_time, back(held).window_time);
  figures.added_latency = difference(now.added_latency, back(held).added_latency);
  return figures;
}

}  // namespace gyrod::live
