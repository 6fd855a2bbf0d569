/// What a scrape costs: families and text of many sensors, all figures known, without the network.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target scrape_benchmark
///   build/benchmark/scrape_benchmark
#include <string>

#include <benchmark/benchmark.h>
#include <prometheus/text_serializer.h>

#include "monitor/collector.hpp"
#include "unit/monitor/fixed_view.hpp"

namespace gyrod::monitor {
namespace {

void scrape(benchmark::State& state) {
  const auto sensors = static_cast<std::size_t>(state.range(0));
  test::Shown shown = test::busy_gyrod();
  shown.channels.clear();
  for (std::size_t i = 0; i < sensors; ++i)
    shown.channels.push_back(test::busy_sensor("vehicle/imu" + std::to_string(i)));
  shown.engine.channels = sensors;
  const Collector collector(
      {.max_channel_series = sensors, .version = "1", .start_time_s = 1.0, .uptime_s = [] { return 1.0; }},
      test::view_of(shown));
  const prometheus::TextSerializer serializer;
  std::size_t bytes = 0;
  for (auto unused : state) {
    bytes = serializer.Serialize(collector.Collect()).size();
    benchmark::DoNotOptimize(bytes);
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
BENCHMARK(scrape)->Arg(10)->Arg(200)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gyrod::monitor
