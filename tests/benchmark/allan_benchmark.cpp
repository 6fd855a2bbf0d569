// The Allan deviation and the fit of its coefficients, without reading.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/allan/allan_deviation.hpp"
#include "core/allan/noise_coefficients.hpp"
#include "core/allan/online_allan.hpp"

namespace {

using namespace gyrod;

std::vector<double> white_noise(std::size_t samples) {
  std::mt19937_64 bits(1);
  std::normal_distribution<double> normal;
  std::vector<double> rate(samples);
  for (double& value : rate) value = normal(bits);
  return rate;
}

void deviation(benchmark::State& state) {
  const std::vector<double> rate = white_noise(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(core::allan_deviation(rate, 100.0));
}
BENCHMARK(deviation)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(10'000'000)
    ->Unit(benchmark::kMillisecond);

void coefficients(benchmark::State& state) {
  const auto points = core::allan_deviation(white_noise(static_cast<std::size_t>(state.range(0))), 100.0);
  for (auto _ : state) benchmark::DoNotOptimize(core::fit_coefficients(points));
}
BENCHMARK(coefficients)->Arg(10'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

void online_step(benchmark::State& state) {
  const std::vector<double> rate = white_noise(1 << 16U);
  core::OnlineAllan estimator;
  std::size_t n = 0;
  for (auto _ : state) estimator.step(rate[n++ % rate.size()]);
  benchmark::DoNotOptimize(estimator.sums());
}
BENCHMARK(online_step);

}  // namespace

BENCHMARK_MAIN();
