#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

EngineOptions patient_for_a_second() {
  EngineOptions options = small_options(1);
  options.max_delay_s = 1.0;
  return options;
}

/// An engine whose one worker passes a gate with each window, and whose clock is set by hand.
struct SlowWorker {
  RecordingSink sink;
  Gatekeeper gate;
  std::atomic<double> now{0.0};
  Engine engine{patient_for_a_second(), window_marker([this] { gate.pass(); }), sink,
                [this] { return now.load(); }};
};

TEST(Engine, IsConservedAtEveryMomentWhileWorkersRun) {
  RecordingSink sink;
  Engine engine(small_options(2), paper_method({}), sink);
  std::atomic<bool> done{false};
  std::thread watcher([&] {
    while (!done) expect_conserved(engine.snapshot().totals);
  });
  auto input = noisy_samples(4000);
  input[1000].rate_radps[1] = std::nan("");
  input[2000].sequence = 5;
  for (const Sample& sample : input) engine.push("imu", {&sample, 1});
  EXPECT_TRUE(engine.stop(std::chrono::seconds{60}));
  done = true;
  watcher.join();
  const Counts counts = engine.snapshot().totals;
  expect_conserved(counts);
  EXPECT_EQ(counts.in_flight, 0U);
  EXPECT_EQ(counts.received, 4000U);
  EXPECT_EQ(counts.published, 3998U);
}

TEST(Engine, RefusesAndCountsWhatComesAfterTheStop) {
  RecordingSink sink;
  Engine engine(small_options(2), window_marker(), sink);
  engine.push("imu", counting_samples(100));
  EXPECT_TRUE(engine.stop(std::chrono::seconds{60}));
  engine.push("imu", counting_samples(10, 100));
  const Counts counts = engine.snapshot().totals;
  EXPECT_EQ(counts.published, 100U);
  EXPECT_EQ(counts.rejected[static_cast<std::size_t>(RejectReason::kShuttingDown)], 10U);
  expect_conserved(counts);
}

TEST(Engine, PassesThroughFlaggedWhenWorkersAreTooSlowAndRecoversByItself) {
  SlowWorker slow;
  auto& [sink, gate, now, engine] = slow;
  gate.set_open(false);
  engine.push("imu", counting_samples(32));  // the worker hangs in this window
  engine.push("imu", counting_samples(64, 32));
  now = 10.0;
  gate.set_open(true);
  engine.wait_idle();
  const auto late = sink.samples("imu");
  ASSERT_EQ(late.size(), 80U);
  EXPECT_NE(late[79].flags & static_cast<std::uint32_t>(SampleFlag::kPassThrough), 0U);
  EXPECT_EQ(late[79].rate_radps[0], 79.0) << "as measured";
  EXPECT_TRUE(engine.channels(1)[0].pass_through);

  engine.push("imu", counting_samples(320, 96));
  engine.wait_idle();
  const auto after = sink.samples("imu");
  EXPECT_EQ(after.back().flags, 0U);
  EXPECT_FALSE(engine.channels(1)[0].pass_through);
  EXPECT_EQ(engine.snapshot().totals.overloads, 1U);
  expect_conserved(engine.snapshot().totals);
}

TEST(Engine, WidensTheHopBeforeItGivesUpDenoising) {
  SlowWorker slow;
  auto& [sink, gate, now, engine] = slow;
  gate.set_open(false);
  engine.push("imu", counting_samples(32));
  now = 0.6;  // past half of the longest delay
  engine.push("imu", counting_samples(64, 32));
  gate.set_open(true);
  engine.wait_idle();
  EXPECT_EQ(engine.snapshot().totals.hops_widened, 1U);
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 80U);
  EXPECT_NE(output[79].flags & static_cast<std::uint32_t>(SampleFlag::kHopWidened), 0U);
  EXPECT_EQ(output[79].flags & static_cast<std::uint32_t>(SampleFlag::kPassThrough), 0U);
}

TEST(Engine, JudgesAnOverloadThatIsOverBeforeItIsLookedAt) {
  SlowWorker slow;
  auto& [sink, gate, now, engine] = slow;
  // From `first` on: a window that the worker hangs in, and 64 samples that come before or after `late_s`.
  const auto overload = [&](std::uint64_t first, double late_s, bool samples_before) {
    gate.set_open(false);
    engine.push("imu", counting_samples(32, first));
    gate.wait_for_entry();
    if (samples_before) engine.push("imu", counting_samples(64, first + 32));
    now = now + late_s;
    if (!samples_before) engine.push("imu", counting_samples(64, first + 32));
    gate.set_open(true);
    engine.wait_idle();
    for (std::uint64_t n = first + 96; n < first + 416; n += 32) {
      engine.push("imu", counting_samples(32, n));
      engine.wait_idle();
    }
  };
  const auto judged = [&engine] {
    engine.judge_health();
    return std::pair(engine.channels(1)[0].health->state, engine.snapshot().overload_step);
  };
  overload(0, 10.0, true);  // past the longest delay of the windows that wait
  ASSERT_FALSE(engine.channels(1)[0].pass_through);
  EXPECT_EQ(judged(), std::pair(Health::kDegraded, 2U));
  EXPECT_EQ(judged().second, 0U) << "and was said once";
  overload(416, 0.6, false);  // past half of the longest delay when the next come
  ASSERT_EQ(sink.samples("imu").back().flags & static_cast<std::uint32_t>(SampleFlag::kHopWidened), 0U);
  EXPECT_EQ(judged(), std::pair(Health::kDegraded, 1U));
  EXPECT_EQ(judged().second, 0U);
}

TEST(Engine, WaitsForWorkersRatherThanLoseOrDegrade) {
  RecordingSink sink;
  EngineOptions options = small_options(1);
  options.max_queued_windows = 1;
  Engine engine(options, paper_method({}), sink);
  const auto input = noisy_samples(5000);
  engine.push("imu", input);
  EXPECT_TRUE(engine.stop(std::chrono::seconds{60}));
  EXPECT_EQ(sink.samples("imu").size(), 5000U);
  EXPECT_EQ(engine.snapshot().totals.hops_widened, 0U);
}

TEST(Engine, ReleasesUndenoisedWhatTheStopsDeadlineCutsOff) {
  RecordingSink sink;
  Gatekeeper gate;
  std::atomic<int> looks{0};
  // Every look at the clock finds a tenth of a second gone; the worker hangs until the deadline is long past.
  const auto clock = [&looks, &gate] {
    const int now = ++looks;
    if (now > 100) gate.set_open(true);
    return 0.1 * now;
  };
  gate.set_open(false);
  Engine engine(small_options(1), window_marker([&gate] { gate.pass(); }), sink, clock);
  engine.push("imu", counting_samples(100));
  EXPECT_FALSE(engine.stop(std::chrono::milliseconds{500}));
  EXPECT_EQ(sequences(sink.samples("imu")), sequences([] {
              std::vector<DenoisedSample> all(100);
              for (std::size_t n = 0; n < all.size(); ++n) all[n].sequence = n;
              return all;
            }()));
  expect_conserved(engine.snapshot().totals);
}

}  // namespace
}  // namespace gyrod::stream
