#include "live/trace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gyrod::live {
namespace {

std::int64_t floor_of_quotient(std::int64_t value, std::int64_t divisor) noexcept {
  const std::int64_t quotient = value / divisor;
  return value % divisor < 0 ? quotient - 1 : quotient;
}

}  // namespace

void TraceMaker::take(std::span<const Point> points) {
  for (const Point& point : points) {
    const std::int64_t number = floor_of_quotient(point.stamp_ns, bucket_ns_);
    if (!open_ || open_->number != number) {
      if (open_) close(*open_, done_);
      open_ = Bucket{number, point.rate_radps, point.rate_radps};
      continue;
    }
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      open_->least[axis] = std::min(open_->least[axis], point.rate_radps[axis]);
      open_->largest[axis] = std::max(open_->largest[axis], point.rate_radps[axis]);
    }
  }
}

Trace TraceMaker::make(bool with_open) {
  Trace made = std::exchange(done_, {});
  if (with_open && open_) close(*open_, made);
  return made;
}

void TraceMaker::close(const Bucket& bucket, Trace& trace) const {
  trace.middle_ns.push_back(bucket.number * bucket_ns_ + bucket_ns_ / 2);
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    trace.least[axis].push_back(bucket.least[axis]);
    trace.largest[axis].push_back(bucket.largest[axis]);
  }
}

std::int64_t bucket_for(double seconds, std::size_t points) noexcept {
  constexpr double kNanoseconds = 1e9;
  return std::max<std::int64_t>(
      1, std::llround(std::ceil(seconds * kNanoseconds / static_cast<double>(points))));
}

void find_gaps(std::span<const Point> points, double sample_rate_hz, std::optional<std::int64_t>& last,
               std::vector<Interval>& gaps) {
  if (!(sample_rate_hz > 0.0)) return;
  const double longest_ns = kGapPeriods * 1e9 / sample_rate_hz;
  for (const Point& point : points) {
    if (last && static_cast<double>(point.stamp_ns - *last) > longest_ns)
      gaps.push_back({*last, point.stamp_ns});
    last = point.stamp_ns;
  }
}

}  // namespace gyrod::live
