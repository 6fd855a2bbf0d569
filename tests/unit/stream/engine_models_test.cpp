#include <algorithm>
#include <atomic>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

TEST(EngineWithModels, UsesAModelFromTheSampleAfterTheNextHopOn) {
  RecordingSink sink;
  EngineOptions options = small_options(2);
  Engine engine(options, testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(320));
  engine.end_of_stream("imu");
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 320U);
  for (std::size_t n = 0; n + 16 < output.size(); ++n) {
    // The answer for sample n is given when sample n + 16 arrives. A model of the window that ends before
    // sample 32 m, whose last sample is 32 m - 1, serves samples 32 (m + 1) and later.
    const std::size_t arrival = n + 16;
    const std::size_t m = arrival / 32 >= 1 ? arrival / 32 - 1 : 0;
    const double model = m == 0 ? 0.0 : 32.0 * static_cast<double>(m) - 1.0;
    EXPECT_EQ(output[n].rate_radps[0], static_cast<double>(n) + 1000.0 * model) << "sample " << n;
  }
}

TEST(EngineWithModels, WindowsOfAFastSensorDoubleAndModelsServeFromTheNextWindowOn) {
  RecordingSink sink;
  Engine engine(small_options(2), testing::last_sample_method(), sink);
  engine.push("imu", testing::at_rate(counting_samples(1024), 500));
  engine.wait_idle();
  std::vector<std::size_t> windows;
  for (const NoiseReport& report : sink.reports("imu")) windows.push_back(report.axis[0].window_samples);
  // 500 Hz: twice doubled from 128 samples, and the hop once from 32.
  EXPECT_EQ(windows, (std::vector<std::size_t>{32,  64,  96,  128, 160, 192, 224, 256, 320, 384,
                                               448, 512, 512, 512, 512, 512, 512, 512, 512, 512}));
  const std::vector<std::size_t> ends{0,   32,  64,  96,  128, 160, 192, 224, 256, 320, 384,
                                      448, 512, 576, 640, 704, 768, 832, 896, 960, 1024};
  const auto output = sink.realtime("imu");
  ASSERT_EQ(output.size(), 1024U);
  for (std::size_t n = 32, i = 1; n < output.size(); ++n) {
    if (n == ends[i + 1]) ++i;
    const double model = i == 1 ? 0.0 : static_cast<double>(ends[i - 1]) - 1.0;
    EXPECT_EQ(output[n].rate_radps[0], static_cast<double>(n) + 1000.0 * model) << "sample " << n;
    EXPECT_EQ(has_flag(output[n], SampleFlag::kHopWidened), false) << "sample " << n;
    EXPECT_EQ(has_flag(output[n], SampleFlag::kWarmingUp), n + 1 < 128) << "sample " << n;
  }
}

TEST(EngineWithModels, WindowsStayAsConfiguredWhereTheyAreNotToFollowTheRate) {
  RecordingSink sink;
  EngineOptions options = small_options(0);
  options.stretch_windows = false;
  Engine engine(options, testing::last_sample_method(), sink);
  engine.push("imu", testing::at_rate(counting_samples(1024), 500));
  EXPECT_EQ(sink.reports("imu").back().axis[0].window_samples, 128U);
  EXPECT_EQ(sink.reports("imu").size(), 32U);
}

TEST(EngineWithModels, WindowsAreShortAgainWhereTheSensorHasBecomeSlow) {
  RecordingSink sink;
  Engine engine(small_options(0), testing::last_sample_method(), sink);
  auto samples = testing::at_rate(counting_samples(1024), 500);
  engine.push("imu", samples);
  for (const Sample& slow : counting_samples(512, 1024)) {
    Sample next = slow;
    next.stamp_ns =
        samples.back().stamp_ns + static_cast<std::int64_t>(slow.sequence - 1023) * 6'666'667;  // 150 Hz
    engine.push("imu", {&next, 1});
  }
  EXPECT_EQ(sink.reports("imu").back().axis[0].window_samples, 128U);
  expect_conserved(engine.snapshot().totals);
}

TEST(EngineWithModels, WindowsOfASensorThatBecomesFastGrowByWhatItSends) {
  RecordingSink sink;
  Engine engine(small_options(0), testing::last_sample_method(), sink);
  auto samples = counting_samples(1024);
  for (const Sample& fast : counting_samples(1024, 1024)) {
    samples.push_back(fast);
    samples.back().stamp_ns =
        samples[1023].stamp_ns + static_cast<std::int64_t>(fast.sequence - 1023) * 2'000'000;  // 500 Hz
  }
  engine.push("imu", samples);
  const auto reports = sink.reports("imu");
  EXPECT_EQ(reports.back().axis[0].window_samples, 512U);
  for (const NoiseReport& report : reports) {
    const auto length = static_cast<double>(report.axis[0].window_samples);
    const auto last = static_cast<double>(report.last_sequence);
    EXPECT_EQ(report.axis[0].tone_amplitude, last + 1.0 - length)
        << "the first sample of the window that ends with " << last;
  }
}

TEST(EngineWithModels, WindowsStayAsLongWhereTheRateIsAboutTheLimit) {
  RecordingSink sink;
  Engine engine(small_options(0), testing::last_sample_method(), sink);
  auto samples = counting_samples(4096);
  std::int64_t stamp_ns = 0;
  for (Sample& sample : samples) {  // 225 Hz, and every other 128 samples 206
    sample.stamp_ns = stamp_ns;
    stamp_ns += sample.sequence / 128 % 2 == 0 ? 4'444'444 : 4'854'369;
  }
  engine.push("imu", samples);
  std::vector<std::size_t> windows;
  for (const NoiseReport& report : sink.reports("imu")) windows.push_back(report.axis[0].window_samples);
  EXPECT_EQ(std::count(windows.begin() + 8, windows.end(), 256U), std::ssize(windows) - 8);
}

TEST(EngineWithModels, ADelayedWorkerChangesNoBits) {
  const auto run = [](std::size_t workers, const std::function<void()>& on_window) {
    RecordingSink sink;
    Engine engine(small_options(workers), testing::last_sample_method(on_window), sink);
    for (const Sample& sample : testing::at_rate(counting_samples(1200), 500))
      engine.push("imu", {&sample, 1});
    engine.end_of_stream("imu");
    engine.wait_idle();
    return std::pair{sink.samples("imu"), sink.realtime("imu")};
  };
  const auto slow = [] {
    for (int i = 0; i < 1000; ++i) std::this_thread::yield();
  };
  const auto [delayed, delayed_realtime] = run(1, slow);
  const auto [undisturbed, realtime] = run(0, {});
  EXPECT_TRUE(same_bits(delayed, undisturbed));
  EXPECT_TRUE(same_bits(delayed_realtime, realtime));
}

TEST(EngineWithModels, AModelRemembersTheWindowsOfItsStreamAcrossAGapAndForgetsThemAtItsEnd) {
  const auto last_count = [](const RecordingSink& sink) { return sink.reports("imu").back().axis[0].modes; };
  RecordingSink sink;
  Engine engine(small_options(1), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(64));
  engine.push("imu", counting_samples(64, 1000));  // too much is missing for a bridge
  engine.wait_idle();
  EXPECT_EQ(last_count(sink), 4U);
  engine.end_of_stream("imu");
  engine.push("imu", counting_samples(32, 2000));
  engine.wait_idle();
  EXPECT_EQ(last_count(sink), 1.0);
}

TEST(EngineWithModels, TellEachAxisTheLeastNoiseThatTheOthersHadAWindowBefore) {
  RecordingSink sink;
  Engine engine(small_options(0), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(64));  // x counts up, y is -x, z half of x
  const auto reports = sink.reports("imu");
  ASSERT_EQ(reports.size(), 2U);
  for (const core::WindowReport& axis : reports[0].axis) EXPECT_EQ(axis.mean, 0.0) << "nobody knows yet";
  EXPECT_EQ(reports[1].axis[0].mean, 15.5) << "z; y is below 0: does not know";
  EXPECT_EQ(reports[1].axis[1].mean, 15.5);
  EXPECT_EQ(reports[1].axis[2].mean, 31.0);
}

/// An engine that has taken 40 samples, and five seconds later its worker still has the first window.
struct LateEngine {
  explicit LateEngine(std::size_t widest_hop)
      : engine(options(widest_hop), testing::last_sample_method([this] { gate.pass(); }), sink,
               [this] { return now.load(); }) {
    gate.set_open(false);
    engine.push("imu", counting_samples(40));
    gate.wait_for_entry();
    now = 5.0;
  }
  static EngineOptions options(std::size_t widest_hop) {
    EngineOptions options = small_options(1);
    options.max_delay_s = 1.0;
    options.max_hop_samples = widest_hop;
    return options;
  }

  RecordingSink sink;
  Gatekeeper gate;
  std::atomic<double> now{0.0};
  Engine engine;
};

/// The widest hop; 32 is the hop itself, so that overload step 1 shows in the models' age alone.
class EngineWithLateModels : public ::testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(WidestHop, EngineWithLateModels, ::testing::Values(32, 64));

TEST_P(EngineWithLateModels, KeepsOlderModelsAndDoesNotWaitWhenTheSlowLoopIsTooLate) {
  LateEngine late(GetParam());
  auto& [sink, gate, now, engine] = late;
  engine.push("imu", counting_samples(100, 40));  // would wait for ever if it waited for the worker
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 124U);
  EXPECT_EQ(output.back().rate_radps[0], 123.0) << "no model yet, but an answer";
  EXPECT_TRUE(has_flag(output.back(), SampleFlag::kHopWidened));
  EXPECT_TRUE(has_flag(sink.realtime("imu").back(), SampleFlag::kHopWidened));
  EXPECT_GE(engine.snapshot().totals.hops_widened, 1U);
  gate.set_open(true);
  now = 5.0;
  engine.wait_idle();
  engine.push("imu", counting_samples(180, 140));  // hops 5 to 10 end in time
  EXPECT_FALSE(has_flag(sink.realtime("imu").back(), SampleFlag::kHopWidened)) << "models are as young again";
  engine.stop(std::chrono::seconds{60});
  expect_conserved(engine.snapshot().totals);
  EXPECT_EQ(engine.snapshot().totals.in_flight, 0U);
}

// The first samples of a stretch have no older models: there are none of it yet.
TEST(EngineWithLateModels, FlagsNoHopOfTheStretchAfterTheOneInWhichTheyWereLate) {
  LateEngine late(small_options(1).hop_samples);
  auto& [sink, gate, now, engine] = late;
  engine.push("imu", counting_samples(60, 40));
  EXPECT_TRUE(has_flag(sink.realtime("imu").back(), SampleFlag::kHopWidened));
  gate.set_open(true);
  engine.wait_idle();
  engine.push("imu", counting_samples(40, 1000));
  const auto realtime = sink.realtime("imu");
  ASSERT_EQ(realtime.size(), 140U);
  for (std::size_t n = 100; n < realtime.size(); ++n)
    EXPECT_FALSE(has_flag(realtime[n], SampleFlag::kHopWidened)) << n;
}

// The model of the last window before a gap is made while the first hop after it runs, and is not for that stretch.
TEST(EngineWithModels, UsesNoModelOfTheStretchBeforeAGap) {
  RecordingSink sink;
  Engine engine(small_options(0), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(100));
  engine.push("imu", counting_samples(70, 1000));
  const auto realtime = sink.realtime("imu");
  ASSERT_EQ(realtime.size(), 170U);
  // The stretch's own first window ends with sample 1031 and serves from its second hop's end on.
  for (std::uint64_t n = 1000; n < 1070; ++n)
    EXPECT_EQ(realtime[n - 900].rate_radps[0], static_cast<double>(n) + (n < 1064 ? 0.0 : 1031e3)) << n;
}

TEST(EngineWithModels, ReleasesTheHeldSamplesAtALongGap) {
  RecordingSink sink;
  Engine engine(small_options(1), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(100));
  engine.push("imu", counting_samples(100, 1000));
  engine.end_of_stream("imu");
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 200U);
  EXPECT_EQ(output[99].sequence, 99U);
  EXPECT_EQ(output[100].sequence, 1000U);
  EXPECT_EQ(output[100].rate_radps[0], 1000.0)
      << "models of the stretch before the gap are not used after it";
  expect_conserved(engine.snapshot().totals);
}

}  // namespace
}  // namespace gyrod::stream
