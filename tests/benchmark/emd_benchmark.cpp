// Speed of the decomposition, on fresh windows: 64 different ones in turn, since on a single one the branch
// predictor learns the data by heart.
//   time_per_sample_imf_sift: time of a whole decomposition over samples x IMFs x sifts
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/emd/emd.hpp"

namespace {

using gyrod::core::Emd;
using gyrod::core::EmdKernel;

constexpr std::size_t kWindows = 64;

std::vector<std::vector<double>> white_noise_windows(std::size_t size) {
  std::mt19937_64 bits(20240503);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> windows(kWindows, std::vector<double>(size));
  for (auto& window : windows) {
    for (double& value : window) {
      value = normal(bits);
    }
  }
  return windows;
}

/// Full decompositions of windows of state.range(0) samples of white noise, 10 sifts.
void decompose(benchmark::State& state, EmdKernel kernel) {
  if (!gyrod::core::is_available(kernel)) {
    state.SkipWithError("this processor does not run the kernel");
    return;
  }
  const auto size = static_cast<std::size_t>(state.range(0));
  const auto windows = white_noise_windows(size);
  Emd emd(size, {}, kernel);
  std::vector<double> imf(size);
  std::size_t window = 0;
  std::size_t imfs = 0;
  for ([[maybe_unused]] auto _ : state) {
    emd.start(windows[window]);
    while (emd.next_imf(imf)) {
      ++imfs;
    }
    benchmark::DoNotOptimize(emd.residue().data());
    window = (window + 1) % kWindows;
  }
  state.counters["time_per_sample_imf_sift"] =
      benchmark::Counter(static_cast<double>(imfs * size) * emd.options().sifts,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["imfs"] = static_cast<double>(imfs) / static_cast<double>(state.iterations());
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(512)->Arg(1024)->Arg(4096)->Arg(16384)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(decompose, fastest, EmdKernel::kFastest)->Apply(sizes);
BENCHMARK_CAPTURE(decompose, avx512, EmdKernel::kAvx512)->Apply(sizes);
BENCHMARK_CAPTURE(decompose, avx2, EmdKernel::kAvx2)->Apply(sizes);
BENCHMARK_CAPTURE(decompose, baseline, EmdKernel::kBaseline)->Apply(sizes);
BENCHMARK_CAPTURE(decompose, reference, EmdKernel::kReference)->Apply(sizes);

}  // namespace

BENCHMARK_MAIN();
