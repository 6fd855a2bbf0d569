#include "monitor/channel_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "live/live.hpp"

namespace gyrod::monitor {
namespace {

enum class Sort : std::size_t { kHealth, kSensor, kNoiseIn, kReduction, kRate };

/// Four digits, enough for a line as thick as a pixel.
double rounded(double value) {
  constexpr double kDigits = 4.0;
  const double scale = std::pow(10.0, kDigits - std::ceil(std::log10(value)));
  return std::round(value * scale) / scale;
}

Json history_of(const std::vector<live::NoiseHistory::Axes>& points, std::size_t axis) {
  Json history = Json::array();
  for (const live::NoiseHistory::Axes& point : points) {
    const auto value = static_cast<double>(point[axis]);
    history.push_back(value > 0.0 ? Json(rounded(value)) : Json(nullptr));
  }
  return history;
}

/// The largest of the axes.
Value largest(const ChannelRow& row, Value ChannelRow::Axis::*figure) {
  Value most;
  for (const ChannelRow::Axis& axis : row.axes) {
    const Value& value = axis.*figure;
    if (value && (!most || *value > *most)) most = value;
  }
  return most;
}

Value sort_figure(const ChannelRow& row, Sort sort) {
  switch (sort) {
    case Sort::kNoiseIn:
      return largest(row, &ChannelRow::Axis::noise_in_radps);
    case Sort::kReduction:
      return largest(row, &ChannelRow::Axis::reduction_db);
    case Sort::kRate:
      return row.sample_rate_hz;
    case Sort::kHealth:
      return static_cast<double>(row.health);
    case Sort::kSensor:
      break;
  }
  return 0.0;
}

/// What is not known comes last in either order; equals are in the order of their ids.
void sort_rows(std::vector<ChannelRow>& rows, Sort sort, bool ascending) {
  std::ranges::sort(rows, {}, &ChannelRow::sensor);
  if (sort == Sort::kSensor) {
    if (!ascending) std::ranges::reverse(rows);
    return;
  }
  std::ranges::stable_sort(rows, [sort, ascending](const ChannelRow& one, const ChannelRow& other) {
    const Value first = sort_figure(one, sort);
    const Value second = sort_figure(other, sort);
    if (!first || !second) return first.has_value() && !second.has_value();
    return ascending ? *first < *second : *first > *second;
  });
}

std::array<bool, stream::kHealthStates> parse_health(const ApiQuery& query) {
  std::array<bool, stream::kHealthStates> wanted{};
  for (const std::string_view word : query.list("health")) {
    std::size_t state = 0;
    std::string all;
    while (state < stream::kHealthStates && stream::name_of(static_cast<stream::Health>(state)) != word) {
      all += (all.empty() ? "" : ", ") + std::string(stream::name_of(static_cast<stream::Health>(state)));
      ++state;
    }
    if (state == stream::kHealthStates)
      ApiQuery::fail("health", word, "states, separated by commas, of " + all);
    wanted[state] = true;
  }
  return wanted;
}

bool is_wanted(const ChannelRow& row, const Listing& listing) {
  const bool any = std::ranges::none_of(listing.health, std::identity{});
  return (any || listing.health[static_cast<std::size_t>(row.health)]) &&
         row.sensor.find(listing.search) != std::string::npos;
}

}  // namespace

ChannelRow row_of(const stream::ChannelSnapshot& sensor) {
  const stream::SensorHealth health = sensor.health.value_or(stream::SensorHealth{});
  const bool reported = has_report(sensor);
  ChannelRow row{.sensor = sensor.sensor,
                 .health = health.state,
                 .state = sensor.state,
                 .sample_rate_hz = known(sensor.sample_rate_hz),
                 .hop_samples = sensor.hop_samples,
                 .overload_step = overload_step(sensor),
                 .noise_source = sensor.last_report.noise_source,
                 .at_rest = sensor.last_report.at_rest,
                 .received = sensor.counts.received,
                 .published = sensor.counts.published,
                 .rejected = sensor.counts.rejected_total(),
                 .missing = sensor.counts.missing};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const core::WindowReport& window = sensor.last_report.axis[axis];
    ChannelRow::Axis& made = row.axes[axis];
    made.health = health.axis[axis];
    if (!reported) continue;
    made.noise_in_radps = known(window.noise_floor);
    made.noise_out_radps = known(window.output_noise);
    if (made.noise_in_radps && made.noise_out_radps)
      made.reduction_db = 20.0 * std::log10(window.noise_floor / window.output_noise);
  }
  return row;
}

std::vector<ChannelRow> rows_of(const View& view) {
  std::vector<ChannelRow> rows;
  view.visit_channels(kAllSensors,
                      [&rows](const stream::ChannelSnapshot& sensor) { rows.push_back(row_of(sensor)); });
  return rows;
}

int worst_overload_step(const std::vector<ChannelRow>& rows) {
  int worst = 0;
  for (const ChannelRow& row : rows) worst = std::max(worst, row.overload_step);
  return worst;
}

Json json_of(const ChannelRow& row, const live::Live* history) {
  const auto points =
      history != nullptr ? history->noise.of(row.sensor) : std::vector<live::NoiseHistory::Axes>{};
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const ChannelRow::Axis& figures = row.axes[axis];
    axes.push_back({{"health", stream::name_of(figures.health.state)},
                    {"value", figures.health.value},
                    {"limit", figures.health.limit},
                    {"noise_in_radps", json_of(figures.noise_in_radps)},
                    {"noise_out_radps", json_of(figures.noise_out_radps)},
                    {"reduction_db", json_of(figures.reduction_db)}});
    if (history != nullptr) axes.back()["history"] = history_of(points, axis);
  }
  return {{"sensor", row.sensor},
          {"health", stream::name_of(row.health)},
          {"state", stream::name_of(row.state)},
          {"sample_rate_hz", json_of(row.sample_rate_hz)},
          {"hop_samples", row.hop_samples},
          {"overload_step", row.overload_step},
          {"noise_source", stream::name_of(row.noise_source)},
          {"at_rest", row.at_rest ? Json(*row.at_rest) : Json(nullptr)},
          {"received", row.received},
          {"published", row.published},
          {"rejected", row.rejected},
          {"missing", row.missing},
          {"axes", std::move(axes)}};
}

Listing Listing::parse(const Request& request) {
  constexpr std::size_t kMostRows = 100'000;
  const ApiQuery query(request, {"health", "search", "sort", "order", "offset", "limit", "history"});
  Listing listing;
  listing.health = parse_health(query);
  listing.search = query.text("search").value_or("");
  listing.sort = query.one_of("sort", {"health", "sensor", "noise_in", "reduction", "rate"}, 0);
  const bool by_name = static_cast<Sort>(listing.sort) == Sort::kSensor;
  listing.ascending = query.one_of("order", {"desc", "asc"}, by_name ? 1 : 0) == 1;
  listing.offset = query.whole("offset", 0, kMostRows, 0);
  listing.limit = query.whole("limit", 1, 10'000, listing.limit);
  listing.history = query.flag("history");
  return listing;
}

Json listing_json(const View& view, const Listing& listing, double time_s) {
  std::vector<ChannelRow> rows = rows_of(view);
  const std::size_t total = rows.size();
  std::erase_if(rows, [&listing](const ChannelRow& row) { return !is_wanted(row, listing); });
  sort_rows(rows, static_cast<Sort>(listing.sort), listing.ascending);
  Json channels = Json::array();
  for (std::size_t i = listing.offset; i < rows.size() && channels.size() < listing.limit; ++i)
    channels.push_back(json_of(rows[i], listing.history ? view.live : nullptr));
  return {{"time_s", time_s},
          {"total", total},
          {"matching", rows.size()},
          {"offset", listing.offset},
          {"channels", std::move(channels)}};
}

}  // namespace gyrod::monitor
