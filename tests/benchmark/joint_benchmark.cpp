/// What the two-speed estimator costs: a sample of the fast loop, a window of the slow one, and its parts.
///
///   cmake --preset benchmark && cmake --build --preset benchmark --target joint_benchmark
///   build/benchmark/joint_benchmark
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/joint/block_riccati.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/joint/noise_shape.hpp"
#include "core/joint/shared_motion.hpp"
#include "core/simulation/simulated_gyro.hpp"

namespace gyrod {
namespace {

using core::BlockRiccati;
using core::BlockSet;
using core::EmdKernel;
using core::JointFit;
using core::JointModel;
using core::KalmanBank;
using core::NoiseModel;

constexpr std::size_t kWindow = 1024;
constexpr double kBandCycles = 0.05;
/// Fresh windows, as the branch predictor learns a repeated one.
constexpr std::size_t kWindows = 64;

/// A simulated drive's yaw rate.
const std::vector<double>& drive() {
  static const std::vector<double> rates = [] {
    core::SimulatedGyroOptions options;
    options.seed = 1;
    options.drive = core::DriveOptions{};
    core::SimulatedGyro gyro(options);
    std::vector<double> all(kWindows * kWindow);
    for (double& rate : all) rate = gyro.next().measured_radps[2];
    return all;
  }();
  return rates;
}

std::span<const double> window(std::size_t index) {
  return std::span(drive()).subspan(index % kWindows * kWindow, kWindow);
}

enum class Colour : std::uint8_t { kWhite, kAr8, kLine, kThreeLines };

/// White noise of the drive's level, or a half of it coloured by an AR(8), as calibrations give it, with a line or three of an eighth of its power.
NoiseModel noise(Colour colour) {
  double squares = 0.0;
  for (std::size_t t = 2; t < kWindow; ++t) {
    const double second = drive()[t] - 2.0 * drive()[t - 1] + drive()[t - 2];
    squares += second * second / (6.0 * static_cast<double>(kWindow - 2));
  }
  NoiseModel model = core::white_noise(squares);
  if (colour == Colour::kWhite) return model;
  model.white_variance = 0.5 * squares;
  model.colour_variance = 0.4 * squares;
  model.colour_order = 8;
  model.colour = {0.25, 0.15, 0.05, 0.05, 0.02, 0.02, 0.01, 0.01};
  constexpr std::array<double, core::kMaxNoiseLines> kCycles{0.2, 0.31, 0.42};
  model.line_count = colour == Colour::kAr8 ? 0 : colour == Colour::kLine ? 1 : kCycles.size();
  for (std::size_t i = 0; i < model.line_count; ++i)
    model.line[i] = {.cycles = kCycles[i], .half_width = 0.003, .variance = 0.125 * squares};
  return model;
}

/// @param max_signal_cycles limit of the signal band, cycles a sample; one half: none
JointModel fitted(std::size_t index, Colour colour, double max_signal_cycles = 0.5) {
  static JointFit fit(kWindow);
  fit.set_max_signal(max_signal_cycles);
  JointModel model;
  core::WindowReport report;
  fit.fit(window(index), noise(colour), model, report);
  return model;
}

/// Arguments: members in use, lag, the noise's colour, as Colour has it.
void step(benchmark::State& state) {
  JointModel model = fitted(0, static_cast<Colour>(state.range(2)));
  for (auto i = static_cast<std::size_t>(state.range(0)); i < core::kMembers; ++i)
    model.members[i].usable = false;
  KalmanBank bank({}, static_cast<std::size_t>(state.range(1)));
  bank.use(model);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(bank.step(drive()[next]));
    next = (next + 1) % drive().size();
  }
  state.counters["states"] = static_cast<double>(model.members[0].states);
}
BENCHMARK(step)
    ->ArgsProduct({{4, 6, 7}, {0, 16, 32}, {1}})
    ->ArgsProduct({{7}, {0, 16, 32}, {2, 3}})
    ->Unit(benchmark::kNanosecond);

/// Within a signal band of 5 Hz at 100 Hz. Argument: lag.
void step_in_band(benchmark::State& state) {
  const JointModel model = fitted(0, Colour::kAr8, kBandCycles);
  KalmanBank bank({}, static_cast<std::size_t>(state.range(0)), core::SignalBandLimit::kPossible);
  bank.use(model);
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(bank.step(drive()[next]));
    next = (next + 1) % drive().size();
  }
}
BENCHMARK(step_in_band)->Arg(0)->Arg(16)->Arg(32)->Unit(benchmark::kNanosecond);

/// Argument: whether within that band.
void hand_over(benchmark::State& state) {
  const bool limited = state.range(0) != 0;
  const JointModel model = fitted(0, Colour::kAr8, limited ? kBandCycles : 0.5);
  KalmanBank bank({}, 16, limited ? core::SignalBandLimit::kPossible : core::SignalBandLimit::kNone);
  for (std::size_t t = 0; t < kWindow; ++t) bank.step(drive()[t]);
  for ([[maybe_unused]] auto _ : state) bank.use(model);
}
BENCHMARK(hand_over)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

/// The slow loop: one window of one axis. Arguments: the noise's colour, as Colour has it; doublings of the window, as fast sensors have them; whether
/// within that band.
void fit_window(benchmark::State& state) {
  const NoiseModel colours = noise(static_cast<Colour>(state.range(0)));
  const std::size_t samples = kWindow << state.range(1);
  JointFit fit(samples);
  if (state.range(2) != 0) fit.set_max_signal(kBandCycles);
  JointModel model;
  core::WindowReport report;
  std::size_t from = 0;
  for ([[maybe_unused]] auto _ : state) {
    fit.fit(std::span(drive()).subspan(from, samples), colours, model, report);
    from = (from + samples) % drive().size();
  }
  constexpr double kHopsPerSecond = 100.0 / 32.0;
  state.counters["axes_at_100_Hz"] = benchmark::Counter(
      static_cast<double>(state.iterations()) / kHopsPerSecond, benchmark::Counter::kIsRate);
}
BENCHMARK(fit_window)
    ->ArgsProduct({{0, 1, 2, 3}, {0}, {0}})
    ->ArgsProduct({{1}, {1, 2}, {0}})
    ->ArgsProduct({{1}, {0}, {1}})
    ->Unit(benchmark::kMicrosecond);

/// Room for windows of a length, which the first sensor that needs them makes for every worker. Argument: doublings of the window.
void make_room(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    JointFit fit(kWindow << state.range(0));
    benchmark::DoNotOptimize(&fit);
  }
}
BENCHMARK(make_room)->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

/// Level and tilt of noise of which no colour is believed. The bands are those of a road that shakes the slow ones.
void part_noise_shape(benchmark::State& state) {
  core::BandPower power{900.0, 20.0, 5.0, 2.1, 1.6, 1.4, 1.1, 0.9};
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(power);
    benchmark::DoNotOptimize(core::likely_shape(power, true));
  }
}
BENCHMARK(part_noise_shape)->Unit(benchmark::kMicrosecond);

/// The windows of a sensor's three axes, once a hop.
void part_shared_motion(benchmark::State& state) {
  core::SharedMotion shared(kWindow, {});
  std::size_t next = 0;
  for ([[maybe_unused]] auto _ : state) {
    shared.compare({window(next), window(next + 1), window(next + 2)});
    next += 3;
  }
}
BENCHMARK(part_shared_motion)->Unit(benchmark::kMicrosecond);

void part_emd(benchmark::State& state) {
  core::Emd emd(kWindow);
  std::vector<double> imf(kWindow);
  std::size_t index = 0;
  for ([[maybe_unused]] auto _ : state) {
    emd.start(window(index++));
    while (emd.next_imf(imf)) benchmark::DoNotOptimize(imf.data());
  }
}
BENCHMARK(part_emd)->Unit(benchmark::kMicrosecond);

void part_spectrum(benchmark::State& state) {
  core::RecencyTapers tapers(kWindow, 2, 4.0);
  std::vector<double> power(tapers.bins());
  std::size_t index = 0;
  for ([[maybe_unused]] auto _ : state) tapers.spectrum(window(index++), power);
}
BENCHMARK(part_spectrum)->Unit(benchmark::kMicrosecond);

/// Modes over the band, for the parts of the fit. Argument of the parts: how many.
core::ModeSet modes(std::int64_t count) {
  core::ModeSet set;
  for (std::int64_t j = 0; j < count; ++j) {
    const double radius = 0.97;
    const double angle = 3.0 / static_cast<double>(1 + j);
    set.add(
        {.a = {2.0 * radius * std::cos(angle), -radius * radius, 0.0}, .drive = 0.1, .slow = j + 1 == count});
  }
  return set;
}

void part_em(benchmark::State& state) {
  core::RecencyTapers tapers(kWindow, 2, 4.0);
  std::vector<double> power(tapers.bins());
  tapers.spectrum(window(0), power);
  core::WhittleFit whittle(tapers.transform_samples(), 0.001);
  whittle.observe(power, noise(Colour::kAr8));
  for ([[maybe_unused]] auto _ : state) {
    core::ModeSet set = modes(state.range(0));
    whittle.iterate(set, 20);
    benchmark::DoNotOptimize(set);
  }
}
BENCHMARK(part_em)->Arg(4)->Arg(6)->Arg(10)->Unit(benchmark::kMicrosecond);

void part_prune(benchmark::State& state) {
  core::WhittleFit whittle(kWindow, 0.001);
  whittle.observe(std::vector<double>(kWindow / 2 + 1, 1.0), core::white_noise(1.0));
  for ([[maybe_unused]] auto _ : state) {
    core::ModeSet set = modes(state.range(0));
    whittle.prune(set, 1e9);
    benchmark::DoNotOptimize(set);
  }
}
BENCHMARK(part_prune)->Arg(4)->Arg(6)->Unit(benchmark::kMicrosecond);

/// One member. Argument: its kind.
void part_design(benchmark::State& state) {
  const JointModel model = fitted(0, Colour::kAr8);
  const BlockSet& blocks = model.members[static_cast<std::size_t>(state.range(0))].blocks;
  core::MemberDesigner designer;
  core::MemberModel member;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(designer.design(blocks, 0.5, member));
  state.counters["states"] = static_cast<double>(member.states);
}
BENCHMARK(part_design)->DenseRange(0, 6)->Unit(benchmark::kMicrosecond);

void riccati(benchmark::State& state, EmdKernel kernel) {
  if (!core::is_available(kernel)) {
    state.SkipWithError("this processor does not run the kernel");
    return;
  }
  const JointModel model = fitted(0, Colour::kAr8);
  const auto solver = std::make_unique<BlockRiccati>(kernel);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(solver->solve(model.members[0].blocks, 0.5));
  }
}
BENCHMARK_CAPTURE(riccati, avx512, EmdKernel::kAvx512)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(riccati, avx2, EmdKernel::kAvx2)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(riccati, baseline, EmdKernel::kBaseline)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gyrod
