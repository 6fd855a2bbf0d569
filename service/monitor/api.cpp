#include "monitor/api.hpp"

#include <cassert>
#include <memory>
#include <string_view>
#include <utility>

#include "live/live.hpp"
#include "monitor/api_query.hpp"
#include "monitor/api_streams.hpp"
#include "monitor/channel_json.hpp"
#include "monitor/channel_rows.hpp"
#include "monitor/event_json.hpp"
#include "monitor/live_json.hpp"
#include "monitor/row_board.hpp"
#include "monitor/sensor_figures.hpp"

namespace gyrod::monitor {
namespace {

constexpr std::string_view kBase = "/api/v1/";
constexpr std::string_view kChannels = "channels/";
constexpr const char* kBusy =
    "16 other sensors are looked at; expected no more at a time: one is let go 60 s after the last look";
constexpr const char* kRoutes =
    "status, config, channels, channels/{sensor}, channels/{sensor}/samples, channels/{sensor}/spectrum, "
    "channels/{sensor}/stream, events, stream";

Answer answer_of(std::string body, int status = 200) {
  return {.status = status,
          .content_type = "application/json",
          .body = std::move(body) + "\n",
          .headers = {{"Cache-Control", "no-store"}}};
}

Answer answer_of(const Json& json) { return answer_of(text_of(json)); }

Answer answer_of(std::unique_ptr<EventSource> events) {
  return {.content_type = "text/event-stream",
          .body = kStreamBegin,
          .headers = {{"Cache-Control", "no-store"}},
          .events = std::move(events)};
}

ApiError no_such_path(std::string_view path) {
  return {404, "no " + in_quotes(path) + " here; expected /api/v1/ and one of " + kRoutes};
}

}  // namespace

Api::Api(ApiOptions options, View view)
    : options_(std::move(options)), view_(std::move(view)), board_(std::make_unique<RowBoard>()) {
  assert(options_.uptime_s && options_.steady_s && options_.time_s && view_.visit_channels && view_.channel);
}

bool Api::is_for(const std::string& path) { return path == "/api" || path.starts_with("/api/"); }

Answer Api::answer(const Request& request) const {
  try {
    return route(request);
  } catch (const ApiError& error) {
    Answer answer = answer_of(text_of(Json{{"error", error.what()}}), error.status());
    if (error.status() == 503) answer.headers.emplace_back("Retry-After", "60");
    return answer;
  }
}

Answer Api::route(const Request& request) const {
  const std::string_view path = request.raw_path;
  if (!path.starts_with(kBase)) throw no_such_path(path);
  const std::string_view rest = path.substr(kBase.size());
  const auto no_query = [&request] { (void)ApiQuery(request, {}); };
  if (rest == "status") {
    no_query();
    return answer_of(status_json(view_, options_, worst_overload_step(rows_of(view_))));
  }
  if (rest == "config" && view_.config) {
    no_query();
    return answer_of(view_.config());
  }
  if (rest == "channels") return answer_of(listing_json(view_, Listing::parse(request), options_.time_s()));
  if (rest == "events")
    return answer_of(events_json(request, view_.live != nullptr ? &view_.live->events : nullptr,
                                 epoch_of(options_.start_time_s)));
  if (rest == "stream" && view_.live != nullptr) {
    const bool with_channels = ApiQuery(request, {"channels"}).flag("channels");
    return answer_of(
        std::make_unique<FleetStream>(view_, options_, *board_, request.last_event_id, with_channels));
  }
  if (rest.starts_with(kChannels)) return route_channel(request, rest.substr(kChannels.size()));
  throw no_such_path(path);
}

/// @param rest "{sensor}" or "{sensor}/WHAT"
Answer Api::route_channel(const Request& request, std::string_view rest) const {
  const std::size_t slash = rest.find('/');
  const auto id = percent_decoded(rest.substr(0, slash));
  if (!id)
    throw ApiError(400, "the sensor's id in " + in_quotes(request.raw_path) +
                            " has a % that two hexadecimal digits do not follow; expected %25 for a %");
  const auto sensor = view_.channel(*id);
  if (!sensor) throw ApiError(404, "no sensor " + in_quotes(*id) + "; expected one of /api/v1/channels");
  if (slash == std::string_view::npos) {
    (void)ApiQuery(request, {});
    return answer_of(channel_json(*sensor, options_.time_s()));
  }
  if (view_.live != nullptr) return route_live(request, *sensor, rest.substr(slash + 1));
  throw no_such_path(request.raw_path);
}

Answer Api::route_live(const Request& request, const stream::ChannelSnapshot& channel,
                       std::string_view what) const {
  const SensorNow now{
      .sensor = channel.sensor, .sample_rate_hz = channel.sample_rate_hz, .now_s = options_.steady_s()};
  const auto watched = [&] {
    auto found = view_.live->tap.look(now.sensor, now.sample_rate_hz, now.now_s);
    if (!found) throw ApiError(503, kBusy);
    return found;
  };
  if (what == "samples") {
    SampleFrames frames(SamplesQuery::parse(request));
    return answer_of(frames.whole(*watched(), now));
  }
  if (what == "spectrum") {
    const double seconds = parse_spectrum_query(request);
    return answer_of(spectrum_json(*watched(), now, seconds, noise_floors(channel)));
  }
  if (what == "stream") {
    const SamplesQuery query = SamplesQuery::parse(request);
    (void)watched();
    return answer_of(
        std::make_unique<SensorStream>(view_, options_, now.sensor, query, request.last_event_id));
  }
  throw no_such_path(request.raw_path);
}

}  // namespace gyrod::monitor
