/// What a scrape, and a list of the JSON API, costs: text of many sensors, all figures known, without the network. As in the daemon, each
/// sensor's snapshot is copied once.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target scrape_benchmark
///   build/benchmark/scrape_benchmark
#include <algorithm>
#include <string>

#include <benchmark/benchmark.h>

#include "live/live.hpp"
#include "monitor/api.hpp"
#include "monitor/collector.hpp"
#include "unit/monitor/fixed_view.hpp"

namespace gyrod::monitor {
namespace {

test::Shown gyrod_with(std::size_t sensors) {
  test::Shown shown = test::busy_gyrod();
  shown.channels.clear();
  for (std::size_t i = 0; i < sensors; ++i)
    shown.channels.push_back(test::busy_sensor("vehicle/imu" + std::to_string(i)));
  shown.engine.channels = sensors;
  return shown;
}

View copying_view_of(const test::Shown& shown) {
  View view = test::view_of(shown);
  view.visit_channels = [&shown](std::size_t limit, const ChannelVisitor& visit) {
    stream::ChannelSnapshot copy;
    for (std::size_t i = 0; i < std::min(limit, shown.channels.size()); ++i) visit(copy = shown.channels[i]);
  };
  return view;
}

void scrape(benchmark::State& state) {
  const auto sensors = static_cast<std::size_t>(state.range(0));
  const test::Shown shown = gyrod_with(sensors);
  const Collector collector({.max_channel_series = sensors,
                             .version = "1",
                             .start_time_s = 1.0,
                             .uptime_s = [] { return 1.0; },
                             .http = [&shown] { return shown.http; }},
                            copying_view_of(shown));
  std::size_t bytes = 0;
  for (auto unused : state) {
    bytes = collector.text().size();
    benchmark::DoNotOptimize(bytes);
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(scrape)->Arg(10)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);

ApiOptions api_options(double& now_s) {
  const auto now = [&now_s] { return now_s; };
  return {.version = "1", .start_time_s = 1.0, .uptime_s = now, .steady_s = now, .time_s = now};
}

void list(benchmark::State& state) {
  const test::Shown shown = gyrod_with(static_cast<std::size_t>(state.range(0)));
  double now_s = 1.0;
  const Api api(api_options(now_s), copying_view_of(shown));
  const Request request{
      .path = "/api/v1/channels", .raw_path = "/api/v1/channels", .query = {}, .last_event_id = {}};
  std::size_t bytes = 0;
  for (auto unused : state) {
    bytes = api.answer(request).body.size();
    benchmark::DoNotOptimize(bytes);
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(list)->Arg(10)->Arg(1000)->Unit(benchmark::kMillisecond);

/// A second of the fleet's stream while every sensor sends.
void second_of_stream(benchmark::State& state) {
  test::Shown shown = gyrod_with(static_cast<std::size_t>(state.range(0)));
  double now_s = 1.0;
  live::Live live;
  View view = copying_view_of(shown);
  view.live = &live;
  const Api api(api_options(now_s), view);
  const Answer answer = api.answer({.path = "/api/v1/stream",
                                    .raw_path = "/api/v1/stream",
                                    .query = {{"channels", "1"}},
                                    .last_event_id = {}});
  std::string text;
  for (auto unused : state) {
    for (auto& channel : shown.channels) ++channel.counts.received;
    now_s += 1.0;
    text.clear();
    answer.events->append(text);
  }
  state.counters["bytes"] = static_cast<double>(text.size());
}
BENCHMARK(second_of_stream)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyrod::monitor
