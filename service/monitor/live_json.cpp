#include "monitor/live_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "live/spectrum.hpp"
#include "monitor/api_query.hpp"

namespace gyrod::monitor {
namespace {

constexpr double kNanoseconds = 1e9;
constexpr double kLeastSeconds = 10.0;

/// The shortest decimal that is this float, so that text is no longer than what is known.
double shortest(float value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  double decimal = 0.0;
  std::from_chars(text.data(), end, decimal);
  return decimal;
}

Json json_of_floats(const std::vector<float>& values) {
  Json made = Json::array();
  for (const float value : values) made.push_back(shortest(value));
  return made;
}

/// Single precision is plenty for a plot.
Json json_of_doubles(const std::vector<double>& values) {
  Json made = Json::array();
  for (const double value : values) made.push_back(shortest(static_cast<float>(value)));
  return made;
}

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * kNanoseconds); }

/// Those from this stamp on.
std::span<const live::Point> since(const std::vector<live::Point>& points, std::int64_t stamp_ns) {
  const auto first = std::ranges::lower_bound(points, stamp_ns, {}, &live::Point::stamp_ns);
  return {first, points.end()};
}

}  // namespace

SamplesQuery SamplesQuery::parse(const Request& request) {
  const ApiQuery query(request, {"seconds", "points"});
  return {.seconds = query.number("seconds", kLeastSeconds, live::Tap::kMostSeconds, 30.0),
          .points = query.whole("points", 100, 4000, 1000)};
}

double parse_spectrum_query(const Request& request) {
  return ApiQuery(request, {"seconds"}).number("seconds", kLeastSeconds, live::Tap::kMostSeconds, 60.0);
}

SampleFrames::SampleFrames(const SamplesQuery& query)
    : query_(query),
      bucket_ns_(live::bucket_for(query.seconds, query.points)),
      raw_(bucket_ns_),
      denoised_(bucket_ns_) {}

Json SampleFrames::whole(const live::Watched& watched, const SensorNow& now) {
  (void)take(watched, now);
  return frame(watched, now, false, true);
}

std::optional<Json> SampleFrames::next(const live::Watched& watched, const SensorNow& now) {
  const bool goes_on = take(watched, now);
  const bool append = goes_on && has_begun_;
  Json made = frame(watched, now, append, false);
  const bool news = !made["raw"]["t_s"].empty() || !made["denoised"]["t_s"].empty();
  const bool first = std::exchange(is_first_, false);
  has_begun_ = append || news;
  return news || !goes_on || first ? std::optional(std::move(made)) : std::nullopt;
}

/// @return false where what was taken before is of another clock
bool SampleFrames::take(const live::Watched& watched, const SensorNow& now) {
  bool goes_on = true;
  points_.clear();
  raw_place_ = watched.raw.read(raw_place_, points_);
  if (!points_.empty() && origin_ns_ && points_.front().stamp_ns <= newest_ns_) {
    begin_anew();
    goes_on = false;
  }
  if (!points_.empty()) {
    newest_ns_ = points_.back().stamp_ns;
    if (!origin_ns_) {
      const std::int64_t begin_ns = newest_ns_ - nanoseconds(query_.seconds);
      origin_ns_ = begin_ns - begin_ns % bucket_ns_;
    }
    const auto shown = since(points_, *origin_ns_);
    raw_.take(shown);
    live::find_gaps(shown, now.sample_rate_hz, gap_from_ns_, gaps_);
    const std::int64_t oldest_ns = newest_ns_ - nanoseconds(query_.seconds);
    std::erase_if(gaps_, [oldest_ns](const live::Interval& gap) { return gap.end_ns < oldest_ns; });
  }
  if (!origin_ns_) return goes_on;
  points_.clear();
  denoised_place_ = watched.denoised.read(denoised_place_, points_);
  denoised_.take(since(points_, *origin_ns_));
  return goes_on;
}

void SampleFrames::begin_anew() {
  raw_ = live::TraceMaker(bucket_ns_);
  denoised_ = live::TraceMaker(bucket_ns_);
  origin_ns_.reset();
  gap_from_ns_.reset();
  gaps_.clear();
}

Json SampleFrames::frame(const live::Watched& watched, const SensorNow& now, bool append, bool with_open) {
  const std::int64_t oldest_ns = newest_ns_ - nanoseconds(query_.seconds);
  return {{"sensor", now.sensor},
          {"watched_s", std::clamp(now.now_s - watched.began_s, 0.0, live::Tap::kMostSeconds)},
          {"from_ns", origin_ns_ ? json_of_stamp(*origin_ns_) : Json(nullptr)},
          {"bucket_s", static_cast<double>(bucket_ns_) / kNanoseconds},
          {"append", append},
          {"raw", json_of(raw_.make(with_open))},
          {"denoised", json_of(denoised_.make(with_open))},
          {"rest", origin_ns_ ? intervals(watched.rests.since(oldest_ns)) : Json::array()},
          {"gaps", intervals(gaps_)}};
}

Json SampleFrames::intervals(const std::vector<live::Interval>& all) const {
  constexpr std::size_t kMost = 1000;
  Json made = Json::array();
  for (std::size_t i = all.size() - std::min(all.size(), kMost); i < all.size(); ++i) {
    const auto offset = [this](std::int64_t stamp_ns) {
      return static_cast<double>(stamp_ns - *origin_ns_) / kNanoseconds;
    };
    made.push_back(Json::array({offset(all[i].begin_ns), offset(all[i].end_ns)}));
  }
  return made;
}

Json SampleFrames::json_of(const live::Trace& trace) const {
  Json times = Json::array();
  for (const std::int64_t middle_ns : trace.middle_ns)
    times.push_back(static_cast<double>(middle_ns - *origin_ns_) / kNanoseconds);
  Json made{{"t_s", std::move(times)}};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    made[std::string(stream::kAxisNames[axis]) + "_min"] = json_of_floats(trace.least[axis]);
    made[std::string(stream::kAxisNames[axis]) + "_max"] = json_of_floats(trace.largest[axis]);
  }
  return made;
}

Json spectrum_json(const live::Watched& watched, const SensorNow& now, double seconds,
                   const std::array<double, stream::kAxes>& noise_floor_radps) {
  const double rate_hz = now.sample_rate_hz;
  std::vector<live::Point> raw;
  (void)watched.raw.read(0, raw);
  const auto newest = [&](const std::vector<live::Point>& points) {
    return points.empty() ? std::span<const live::Point>{}
                          : since(points, points.back().stamp_ns - nanoseconds(seconds));
  };
  const auto raw_part = newest(raw);
  const auto length = live::stretch_for(raw_part.size());
  std::optional<live::Spectrum> before;
  std::optional<live::Spectrum> after;
  if (length && rate_hz > 0.0) {
    before = live::spectrum_of(raw_part, rate_hz, *length);
    std::vector<live::Point> denoised;
    (void)watched.denoised.read(0, denoised);
    after = live::spectrum_of(newest(denoised), rate_hz, *length);
  }
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const double floor = noise_floor_radps[axis];
    axes.push_back(
        {{"raw", before ? json_of_doubles(before->density[axis]) : Json(nullptr)},
         {"denoised", after ? json_of_doubles(after->density[axis]) : Json(nullptr)},
         {"noise_floor", rate_hz > 0.0 ? json_if_known(floor * std::sqrt(2.0 / rate_hz)) : Json(nullptr)}});
  }
  const bool short_of = !before && rate_hz > 0.0;
  return {
      {"sensor", now.sensor},
      {"samples_used", before ? before->samples : 0},
      {"frequency_hz", before ? json_of_doubles(before->frequency_hz) : Json::array()},
      {"axes", std::move(axes)},
      {"needs_s", short_of ? Json(static_cast<double>(2 * live::kLeastStretch) / rate_hz) : Json(nullptr)}};
}

}  // namespace gyrod::monitor
