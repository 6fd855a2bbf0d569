#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"

namespace gyrod::stream {
namespace {

/// An engine whose time is the test's. Silent after 2 s, forgotten after 100 s.
class EngineInSilence : public ::testing::TestWithParam<std::size_t> {
 protected:
  static EngineOptions options() {
    EngineOptions options = small_options(GetParam());
    options.silent_after_s = 2.0;
    options.forget_after_s = 100.0;
    options.noise = [](std::string_view) { return ChannelNoise{}; };
    return options;
  }

  void at(double now_s) {
    now_s_ = now_s;
    engine_.tend();
    engine_.wait_idle();
  }

  std::atomic<double> now_s_{0.0};
  RecordingSink sink_;
  Engine engine_{options(), testing::last_sample_method(), sink_, [this] { return now_s_.load(); }};
};
INSTANTIATE_TEST_SUITE_P(Workers, EngineInSilence, ::testing::Values(0, 2));

TEST_P(EngineInSilence, ReleasesWhatAWindowHoldsOnceNothingHasComeForLongEnough) {
  engine_.push("imu", counting_samples(100));
  at(2.0);
  EXPECT_EQ(sink_.samples("imu").size(), 84U) << "not yet";
  EXPECT_EQ(engine_.snapshot().silent_channels, 0U);
  at(2.1);
  const auto output = sink_.samples("imu");
  ASSERT_EQ(output.size(), 100U);
  EXPECT_TRUE(has_flag(output[84], SampleFlag::kTail));
  EXPECT_EQ(engine_.snapshot().silent_channels, 1U);
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kSilent);
  EXPECT_TRUE(sink_.ended_after("imu").empty()) << "silent is not ended";
  at(50.0);
  EXPECT_EQ(engine_.snapshot().totals.silences, 1U) << "one silence, however long";
  expect_conserved(engine_.snapshot().totals);
}

TEST_P(EngineInSilence, BeginsANewWindowAfterItAndCountsWhatWasMissing) {
  engine_.push("imu", counting_samples(200));
  at(10.0);
  engine_.push("imu", counting_samples(100, 203));  // 3 missing: a bridge otherwise
  EXPECT_EQ(engine_.snapshot().silent_channels, 0U);
  engine_.end_of_stream("imu");
  const auto output = sink_.samples("imu");
  ASSERT_EQ(output.size(), 300U);
  EXPECT_TRUE(has_flag(output[200], SampleFlag::kWarmingUp));
  const Counts counts = engine_.snapshot().totals;
  EXPECT_EQ(counts.missing, 3U);
  EXPECT_EQ(counts.bridged, 0U);
  expect_conserved(counts);
}

TEST_P(EngineInSilence, ChangesNoBitsWhereTheSamplesInItAreLostAnyway) {
  RecordingSink undisturbed;
  Engine reference(small_options(0), testing::last_sample_method(), undisturbed);
  for (const std::uint64_t first : {0U, 500U}) {
    reference.push("imu", counting_samples(300, first));
    engine_.push("imu", counting_samples(300, first));
    at(now_s_ + 10.0);
  }
  reference.end_of_stream("imu");
  EXPECT_TRUE(same_bits(sink_.samples("imu"), undisturbed.samples("imu")));
  EXPECT_EQ(engine_.snapshot().totals.missing, 200U);
}

TEST_P(EngineInSilence, ForgetsASensorAndKeepsItsCounts) {
  engine_.push("imu", counting_samples(100));
  engine_.push("other", counting_samples(50));
  at(3.0);
  now_s_ = 60.0;
  engine_.push("other", counting_samples(50, 50));
  at(99.0);
  EXPECT_EQ(engine_.snapshot().channels, 2U);
  at(101.0);
  const EngineSnapshot snapshot = engine_.snapshot();
  EXPECT_EQ(snapshot.channels, 1U);
  EXPECT_EQ(engine_.channels(8).front().sensor, "other");
  EXPECT_EQ(snapshot.forgotten_channels, 1U);
  EXPECT_EQ(snapshot.totals.published, 200U);
  EXPECT_THAT(sink_.ended_after("imu"), ::testing::ElementsAre(100U));
  expect_conserved(snapshot.totals);
  engine_.push("imu", counting_samples(40));  // numbers begin anew: nobody remembers the old ones
  EXPECT_EQ(engine_.snapshot().totals.rejected_total(), 0U);
  EXPECT_EQ(engine_.snapshot().channels, 2U);
}

TEST_P(EngineInSilence, AForgottenSensorMakesRoomForAnother) {
  for (int n = 0; n < 8; ++n) engine_.push("imu" + std::to_string(n), counting_samples(10));
  EXPECT_EQ(engine_.push("late", counting_samples(10)), 0U);
  at(3.0);
  at(200.0);
  EXPECT_EQ(engine_.push("late", counting_samples(10)), 10U);
}

TEST_P(EngineInSilence, ForgetsASensorThatHasEnded) {
  engine_.push("imu", counting_samples(100));
  engine_.end_of_stream("imu");
  at(99.0);
  EXPECT_EQ(engine_.snapshot().channels, 1U);
  EXPECT_EQ(engine_.snapshot().totals.silences, 0U) << "an end is none";
  at(101.0);
  EXPECT_EQ(engine_.snapshot().channels, 0U);
  EXPECT_THAT(sink_.ended_after("imu"), ::testing::ElementsAre(100U)) << "told once";
}

TEST_P(EngineInSilence, IsToldByTheBusAtOnceAndTheStateSaysWhy) {
  engine_.push("imu", counting_samples(100));
  engine_.fall_silent("imu", ChannelState::kDeadlineMissed);
  engine_.fall_silent("imu", ChannelState::kDeadlineMissed);
  engine_.fall_silent("unknown", ChannelState::kDeadlineMissed);
  engine_.wait_idle();
  EXPECT_EQ(sink_.samples("imu").size(), 100U);
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kDeadlineMissed);
  EXPECT_EQ(engine_.snapshot().totals.silences, 1U);
  at(10.0);
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kDeadlineMissed) << "the first reason stays";
  engine_.push("imu", counting_samples(10, 105));
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kActive);
  EXPECT_EQ(engine_.snapshot().totals.missing, 5U);
  at(20.0);
  at(200.0);
  EXPECT_EQ(engine_.snapshot().channels, 0U) << "forgotten, as any silent one";
}

TEST_P(EngineInSilence, AnEndStaysOneWhateverTheReason) {
  engine_.push("imu", counting_samples(100));
  engine_.end_of_stream("imu");
  engine_.wait_idle();
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kEnded);
  engine_.fall_silent("imu", ChannelState::kLivelinessLost);
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kLivelinessLost);
  EXPECT_THAT(sink_.ended_after("imu"), ::testing::ElementsAre(100U));
  EXPECT_EQ(engine_.snapshot().totals.silences, 0U) << "its window was closed by the end";
  engine_.push("imu", counting_samples(10));
  EXPECT_EQ(engine_.channels(1).front().state, ChannelState::kActive);
}

TEST_P(EngineInSilence, ASensorThatRebootsMeanwhileBeginsAnewWithItsFirstSample) {
  engine_.push("imu", counting_samples(300, 1000));
  at(10.0);
  std::vector<Sample> rebooted = counting_samples(100);  // numbers from 0, and a clock that is back in 1970
  for (Sample& sample : rebooted) sample.stamp_ns = static_cast<std::int64_t>(sample.sequence) * 10'000'000;
  EXPECT_EQ(engine_.push("imu", rebooted), 100U);
  engine_.end_of_stream("imu");
  const Counts counts = engine_.snapshot().totals;
  EXPECT_EQ(counts.restarts, 1U);
  EXPECT_EQ(counts.missing, 0U);
  EXPECT_EQ(counts.rejected_total(), 0U);
  EXPECT_EQ(sink_.samples("imu").size(), 400U);
  expect_conserved(counts);
}

TEST(Engine, NeverForgetsWhereItIsNotAskedTo) {
  double now_s = 0.0;
  RecordingSink sink;
  EngineOptions options = small_options();
  options.silent_after_s = options.forget_after_s = 0.0;
  Engine engine(options, window_marker(), sink, [&now_s] { return now_s; });
  engine.push("imu", counting_samples(100));
  now_s = 1e9;
  engine.tend();
  EXPECT_EQ(engine.snapshot().channels, 1U);
  EXPECT_EQ(engine.snapshot().totals.in_flight, 20U);
}

TEST(Engine, RefusesTimesOfSilenceThatAreNone) {
  RecordingSink sink;
  EngineOptions options = small_options();
  options.silent_after_s = 5.0;
  options.forget_after_s = 4.0;
  EXPECT_THAT([&] { Engine(options, window_marker(), sink); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("forget_after_s is 4")));
}

}  // namespace
}  // namespace gyrod::stream
