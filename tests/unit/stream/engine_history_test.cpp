// A process that serves a sensor which was served before: what was published fills the window and does not leave again.
#include <atomic>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"

namespace gyrod::stream {
namespace {

constexpr std::uint64_t kHistory = 300;  // two full windows and a part
constexpr std::uint64_t kAll = 1000;

EngineOptions with_history(EngineOptions options, PublishedMark mark) {
  options.published_before = [mark](std::string_view) { return mark; };
  return options;
}

PublishedMark mark_at(std::uint64_t sequence) { return {sequence, sample_at(sequence).stamp_ns}; }

std::vector<DenoisedSample> from(const std::vector<DenoisedSample>& samples, std::uint64_t sequence) {
  const auto first = std::ranges::find(samples, sequence, &DenoisedSample::sequence);
  return {first, samples.end()};
}

/// 0: the window method, else the model method. Both with two workers.
class EngineWithHistory : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static MethodFactory method() {
    return GetParam() == 0 ? MethodFactory{window_marker()} : MethodFactory{testing::last_sample_method()};
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, EngineWithHistory, ::testing::Values(0, 1));

// The expected bits are those of a process that was never interrupted.
TEST_P(EngineWithHistory, PublishesTheRestWithTheBitsOfOneThatWasNeverInterrupted) {
  RecordingSink whole;
  RecordingSink restarted;
  Engine one(small_options(2), method(), whole);
  Engine other(with_history(small_options(2), mark_at(kHistory - 1)), method(), restarted);
  one.push("imu", noisy_samples(kAll));
  EXPECT_EQ(other.push("imu", noisy_samples(kAll)), kAll - kHistory);
  one.stop(std::chrono::seconds{60});
  other.stop(std::chrono::seconds{60});
  EXPECT_TRUE(same_bits(restarted.samples("imu"), from(whole.samples("imu"), kHistory)));
  EXPECT_EQ(restarted.samples("imu").size(), kAll - kHistory);
  EXPECT_FALSE(has_flag(restarted.samples("imu").front(), SampleFlag::kWarmingUp));
  if (GetParam() == 1) {
    EXPECT_TRUE(same_bits(restarted.realtime("imu"), from(whole.realtime("imu"), kHistory)));
  }
  const Counts counts = other.snapshot().totals;
  EXPECT_EQ(counts.rejected[static_cast<std::size_t>(RejectReason::kHistory)], kHistory);
  EXPECT_EQ(counts.published, kAll - kHistory);
  expect_conserved(counts);
}

TEST_P(EngineWithHistory, TakesASensorThatHasEndedOrBegunAnewForANewOne) {
  RecordingSink sink;
  Engine engine(with_history(small_options(0), mark_at(kHistory - 1)), method(), sink);
  engine.push("ended", counting_samples(100));
  engine.end_of_stream("ended");
  EXPECT_EQ(engine.push("ended", counting_samples(100)), 100U);

  engine.push("reset", counting_samples(200));
  // The gate believes the eighth sample of another numbering; the seven before it are refused as out of order.
  EXPECT_EQ(engine.push("reset", counting_samples(100)), 100U - 7U);
  expect_conserved(engine.snapshot().totals);
}

TEST_P(EngineWithHistory, TakesNothingForHistoryThatComesLongAfterTheSensorsFirstSamples) {
  std::atomic<double> now_s{0.0};
  RecordingSink sink;
  Engine engine(with_history(small_options(0), mark_at(kHistory - 1)), method(), sink,
                [&now_s] { return now_s.load(); });
  EXPECT_EQ(engine.push("imu", counting_samples(10)), 0U);
  now_s = 9.9;
  EXPECT_EQ(engine.push("imu", counting_samples(10, 10)), 0U);
  now_s = 10.1;
  EXPECT_EQ(engine.push("imu", counting_samples(10, 20)), 10U);
}

// The expected bits are those of an engine that served the sensor all the time.
TEST_P(EngineWithHistory, GoesOnBehindTheMarkOfTheProcessThatServedBefore) {
  RecordingSink whole;
  RecordingSink second;
  Engine one(small_options(2), method(), whole);
  Engine other(small_options(2), method(), second);
  one.push("imu", noisy_samples(kAll));
  other.continue_after("imu", mark_at(kHistory - 1));
  EXPECT_EQ(other.push("imu", noisy_samples(kAll)), kAll - kHistory);
  one.stop(std::chrono::seconds{60});
  other.stop(std::chrono::seconds{60});
  EXPECT_TRUE(same_bits(second.samples("imu"), from(whole.samples("imu"), kHistory)));
  expect_conserved(other.snapshot().totals);
}

TEST_P(EngineWithHistory, TellsUpToWhereItHasTakenASensor) {
  RecordingSink sink;
  Engine engine(small_options(0), method(), sink);
  EXPECT_FALSE(engine.taken_up_to("imu").has_value());
  engine.push("imu", counting_samples(100));
  EXPECT_EQ(engine.taken_up_to("imu")->sequence, 99U);
  EXPECT_EQ(engine.taken_up_to("imu")->stamp_ns, sample_at(99).stamp_ns);
  engine.end_of_stream("imu");
  EXPECT_EQ(engine.taken_up_to("imu")->sequence, 99U);
  engine.continue_after("imu", mark_at(150));
  engine.push("imu", counting_samples(10, 100));
  EXPECT_EQ(engine.taken_up_to("imu")->sequence, 150U) << "another one has taken that already";
  engine.push("imu", counting_samples(60, 110));
  EXPECT_EQ(engine.taken_up_to("imu")->sequence, 169U);
  engine.stop(std::chrono::seconds{60});
  EXPECT_EQ(sink.samples("imu").size(), 100U + 19U);
}

// The sensor has begun anew with its numbers, not with its clock, while another process served it.
TEST_P(EngineWithHistory, TheMarkThatWasToldCountsMoreThanAnOlderOneOfItsOwn) {
  RecordingSink sink;
  Engine engine(with_history(small_options(0), {1'000'000, sample_at(10).stamp_ns}), method(), sink);
  engine.continue_after("imu", mark_at(150));
  EXPECT_EQ(engine.push("imu", counting_samples(20, 140)), 9U);
}

// A second that was served elsewhere, and a sample that nobody has.
TEST_P(EngineWithHistory, MissesNothingOfASensorThatOthersServedMeanwhile) {
  RecordingSink sink;
  Engine engine(small_options(0), method(), sink);
  engine.push("imu", counting_samples(100));
  engine.give_up("imu");
  EXPECT_EQ(sink.samples("imu").size(), 100U) << "what was taken leaves";
  engine.push("imu", counting_samples(100, 200));
  EXPECT_EQ(engine.snapshot().totals.missing, 0U);
  engine.push("imu", counting_samples(10, 301));
  EXPECT_EQ(engine.snapshot().totals.missing, 1U);
}

TEST_P(EngineWithHistory, WaitsAMinuteForWhatComesLateOfThatBeforeTheMark) {
  std::atomic<double> now_s{0.0};
  RecordingSink sink;
  Engine engine(small_options(0), method(), sink, [&now_s] { return now_s.load(); });
  engine.continue_after("imu", mark_at(kHistory - 1));
  EXPECT_EQ(engine.push("imu", counting_samples(10)), 0U);
  now_s = 59.9;
  EXPECT_EQ(engine.push("imu", counting_samples(10, 10)), 0U);
  now_s = 60.1;
  EXPECT_EQ(engine.push("imu", counting_samples(10, 20)), 10U);
}

/// A clock that a test sets.
class EngineThatLosesSight : public EngineWithHistory {
 protected:
  static std::uint64_t history_in(const Counts& counts) {
    return counts.rejected[static_cast<std::size_t>(RejectReason::kHistory)];
  }
  /// The sensor is lost, comes again and sends all that it has sent once more.
  void expect_the_rest_of(std::size_t sent, std::uint64_t published) {
    engine_.end_of_stream("imu");
    engine_.come_again("imu");
    EXPECT_EQ(engine_.push("imu", counting_samples(sent)), sent - published);
    expect_conserved(engine_.snapshot().totals);
  }
  double now_s_ = 100.0;
  RecordingSink sink_;
  Engine engine_{small_options(0), method(), sink_, [this] { return now_s_; }};
};
INSTANTIATE_TEST_SUITE_P(Methods, EngineThatLosesSight, ::testing::Values(0, 1));

TEST_P(EngineThatLosesSight, PublishesAgainOnlyWhatTheWindowHeldOfASensorThatComesBack) {
  engine_.push("imu", counting_samples(100));
  const std::uint64_t published = engine_.snapshot().totals.published;
  ASSERT_GT(published, 60U);
  ASSERT_LT(published, 100U);
  now_s_ += 10.0;
  engine_.end_of_stream("imu");
  now_s_ += 1.0;
  engine_.come_again("imu");
  EXPECT_EQ(engine_.push("imu", counting_samples(150)), 150U - published);
  engine_.stop(std::chrono::seconds{60});
  EXPECT_EQ(history_in(engine_.snapshot().totals), published);
  EXPECT_EQ(engine_.snapshot().totals.missing, 0U);
  EXPECT_EQ(sink_.samples("imu").size(), 100U + 150U - published);
  expect_conserved(engine_.snapshot().totals);
}

// Silence empties the window long before the sensor is known to be lost.
TEST_P(EngineThatLosesSight, PublishesAgainWhatLeftWhenASensorFellSilentBeforeItWasLost) {
  engine_.push("imu", counting_samples(100));
  const std::uint64_t published = engine_.snapshot().totals.published;
  engine_.fall_silent("imu", ChannelState::kSilent);
  ASSERT_EQ(engine_.snapshot().totals.published, 100U);
  now_s_ += 10.0;
  expect_the_rest_of(150, published);
}

// One that was heard again for long had its readers back.
TEST_P(EngineThatLosesSight, ForgetsASilenceThatIsLongOver) {
  engine_.push("imu", counting_samples(100));
  engine_.fall_silent("imu", ChannelState::kSilent);
  now_s_ += 2.0;
  engine_.push("imu", counting_samples(50, 100));
  now_s_ += 0.9;
  engine_.push("imu", counting_samples(50, 150));
  const std::uint64_t published = engine_.snapshot().totals.published;
  ASSERT_GT(published, 150U);
  now_s_ += 5.0;
  expect_the_rest_of(200, published);
}

// Numbers that are missing are not among those that the window holds.
TEST_P(EngineThatLosesSight, CountsWhatTheWindowHeldBySamplesNotByNumbers) {
  std::vector<Sample> samples = counting_samples(120);
  std::erase_if(samples, [](const Sample& sample) { return sample.sequence >= 95 && sample.sequence < 98; });
  engine_.push("imu", samples);
  const std::uint64_t published = engine_.snapshot().totals.published;
  const std::uint64_t newest = sink_.samples("imu").back().sequence;
  engine_.end_of_stream("imu");
  engine_.come_again("imu");
  EXPECT_EQ(engine_.push("imu", samples), samples.size() - published) << "newest published: " << newest;
}

TEST_P(EngineThatLosesSight, PublishesAgainWhatHadWaitedDuringAPauseAndCountsWhatNobodyKept) {
  engine_.push("imu", counting_samples(100));
  const std::uint64_t published = engine_.snapshot().totals.published;
  ASSERT_GT(published, 60U);
  now_s_ += 10.0;  // the pause; readers are lost, too
  engine_.push("imu", counting_samples(20, 100));
  now_s_ += 0.1;
  engine_.end_of_stream("imu");
  now_s_ += 1.0;
  engine_.come_again("imu");
  EXPECT_EQ(engine_.push("imu", counting_samples(90, 60)), 150U - published);
  EXPECT_EQ(history_in(engine_.snapshot().totals), published - 60U);

  now_s_ += 10.0;
  engine_.end_of_stream("imu");
  engine_.come_again("imu");
  EXPECT_EQ(engine_.push("imu", counting_samples(10, 153)), 10U);
  EXPECT_EQ(engine_.snapshot().totals.missing, 3U);
  expect_conserved(engine_.snapshot().totals);
}

// A hiccup of the machine shortly before a pause that the leases did not outlast: they ran out in the pause, whatever is told of first.
TEST_P(EngineThatLosesSight, LostItsReadersInTheLongestOfTheLastSilences) {
  engine_.push("imu", counting_samples(50));
  now_s_ += 1.5;  // the hiccup
  engine_.push("imu", counting_samples(50, 50));
  const std::uint64_t published = engine_.snapshot().totals.published;
  ASSERT_GT(published, 60U);
  now_s_ += 3.0;  // the pause
  expect_the_rest_of(150, published);
}

TEST_P(EngineThatLosesSight, LostItsReadersInAPauseAndNotInTheHiccupBehindIt) {
  engine_.push("imu", counting_samples(100));
  const std::uint64_t published = engine_.snapshot().totals.published;
  now_s_ += 3.0;  // the pause
  engine_.push("imu", counting_samples(50, 100));
  now_s_ += 1.5;  // the hiccup
  engine_.push("imu", counting_samples(50, 150));
  now_s_ += 0.5;
  expect_the_rest_of(200, published);
}

TEST_P(EngineThatLosesSight, TakesASensorThatSendsOnWithoutAnEndForTheSame) {
  engine_.push("imu", counting_samples(100));
  const std::uint64_t published = engine_.snapshot().totals.published;
  engine_.come_again("imu");
  EXPECT_EQ(engine_.push("imu", counting_samples(150)), 150U - published);
  engine_.come_again("unknown");
  expect_conserved(engine_.snapshot().totals);
}

TEST(EngineHistory, OfASensorThatDoesNotCountIsToldByItsStamps) {
  RecordingSink sink;
  std::vector<Sample> samples = counting_samples(100);
  for (Sample& sample : samples) sample.sequence = 0;
  Engine engine(with_history(small_options(0), {0, samples[59].stamp_ns}), window_marker(), sink);
  EXPECT_EQ(engine.push("imu", samples), 40U);
  engine.stop(std::chrono::seconds{60});
  EXPECT_EQ(sink.samples("imu").front().stamp_ns, samples[60].stamp_ns);
}

}  // namespace
}  // namespace gyrod::stream
