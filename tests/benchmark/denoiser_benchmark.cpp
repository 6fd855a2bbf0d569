/// What a window costs, and how many sensors one core serves.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target denoiser_benchmark
///   build/benchmark/denoiser_benchmark
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/denoise/denoiser.hpp"
#include "core/simulation/simulated_gyro.hpp"
#include "stream/engine.hpp"
#include "stream/paper_method.hpp"

namespace gyrod {
namespace {

core::SimulatedGyro driving_gyro(std::uint64_t seed) {
  core::SimulatedGyroOptions options;
  options.seed = seed;
  options.drive = core::DriveOptions{};
  return core::SimulatedGyro(options);
}

/// Fresh windows, as the branch predictor learns a repeated one: 64 stretches of a drive, yaw axis.
std::vector<std::vector<double>> windows(std::size_t samples) {
  constexpr std::size_t kWindows = 64;
  core::SimulatedGyro gyro = driving_gyro(1);
  std::vector<std::vector<double>> all(kWindows, std::vector<double>(samples));
  for (auto& window : all) {
    for (double& rate : window) rate = gyro.next().measured_radps[2];
  }
  return all;
}

void denoise_one_axis(benchmark::State& state) {
  const auto samples = static_cast<std::size_t>(state.range(0));
  const auto input = windows(samples);
  core::Denoiser denoiser(samples);
  std::vector<double> out(samples);
  core::WindowReport report;
  std::size_t next = 0;
  for (auto _ : state) {
    denoiser.denoise(input[next], out, report);
    benchmark::DoNotOptimize(out.data());
    next = (next + 1) % input.size();
  }
}
BENCHMARK(denoise_one_axis)->Arg(512)->Arg(1024)->Arg(2048)->Arg(4096)->Unit(benchmark::kMicrosecond);

class NullSink final : public stream::Sink {
 public:
  void on_samples(std::string_view, std::span<const stream::DenoisedSample>) noexcept override {}
  void on_report(std::string_view, const stream::NoiseReport&) noexcept override {}
  void on_end(std::string_view) noexcept override {}
};

/// Sensors that send sample after sample in turn, default settings, one thread; full windows only. The
/// counter says how many sensors of 100 Hz and three axes that thread keeps up with.
void sensors_per_core(benchmark::State& state) {
  const auto sensors = static_cast<std::size_t>(state.range(0));
  stream::EngineOptions options;
  options.workers = 0;
  NullSink sink;
  stream::Engine engine(options, stream::paper_method({}), sink);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < sensors; ++i) {
    names.push_back("sensor" + std::to_string(i));
  }
  // Made before the clock runs: a gyro that is there costs nothing.
  constexpr std::size_t kStock = 4096;
  std::vector<std::vector<std::array<double, stream::kAxes>>> rates(sensors);
  for (std::size_t i = 0; i < sensors; ++i) {
    core::SimulatedGyro gyro = driving_gyro(i + 1);
    for (std::size_t n = 0; n < kStock; ++n) rates[i].push_back(gyro.next().measured_radps);
  }
  std::uint64_t sequence = 0;
  const auto push_one_each = [&] {
    const auto stamp_ns = static_cast<std::int64_t>(sequence) * 10'000'000;
    for (std::size_t i = 0; i < sensors; ++i) {
      const stream::Sample pushed{sequence, stamp_ns, rates[i][sequence % kStock]};
      engine.push(names[i], {&pushed, 1});
    }
    ++sequence;
  };
  for (std::size_t n = 0; n < options.window_samples; ++n) push_one_each();
  for (auto _ : state) push_one_each();
  const double samples = static_cast<double>(state.iterations()) * static_cast<double>(sensors);
  constexpr double kRateHz = 100.0;
  state.counters["sensors_at_100_Hz"] = benchmark::Counter(samples / kRateHz, benchmark::Counter::kIsRate);
}
BENCHMARK(sensors_per_core)->Arg(1)->Arg(30)->Arg(500)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gyrod
