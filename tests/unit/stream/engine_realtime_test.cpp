#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"

namespace gyrod::stream {
namespace {

using ::testing::Each;

std::uint64_t realtime_count(const Engine& engine) { return engine.snapshot().totals.realtime; }

TEST(EngineInRealTime, AnswersEveryAcceptedSampleOnceAtOnceWithItsOwnStamp) {
  RecordingSink sink;
  Engine engine(small_options(), testing::last_sample_method(), sink);
  auto input = counting_samples(200, 7);
  input[50].rate_radps[2] = std::nan("");
  std::vector<std::uint64_t> expected;
  for (const Sample& sample : input) {
    if (engine.push("imu", {&sample, 1}) == 1) expected.push_back(sample.sequence);
    ASSERT_EQ(sequences(sink.realtime("imu")), expected) << "not later than its push()";
  }
  ASSERT_EQ(expected.size(), 199U) << "one is refused, and the place that is bridged for it is not published";
  EXPECT_EQ(sink.realtime("imu").back().stamp_ns, input.back().stamp_ns);
  engine.end_of_stream("imu");
  EXPECT_EQ(sink.realtime("imu").size(), 199U) << "an end releases what lags, and nothing twice";
  EXPECT_EQ(realtime_count(engine), 199U);
  expect_conserved(engine.snapshot().totals);
}

TEST(EngineInRealTime, AnswersABatchAsABatch) {
  RecordingSink sink;
  Engine engine(small_options(), testing::last_sample_method(), sink);
  const auto input = counting_samples(60);
  for (std::size_t n = 0; n < 30; ++n) engine.push("imu", {&input[n], 1});
  engine.push("imu", std::span<const Sample>(input).subspan(30));
  std::vector<std::size_t> expected(30, 1);
  expected.push_back(30);
  EXPECT_EQ(sink.realtime_calls(), expected);
}

// Who keeps note of what has left keeps it a release at a time: a killed daemon's next one repeats no more than one.
TEST(EngineInRealTime, LetsALongRunLeaveInPartsOfBoundedLength) {
  RecordingSink sink;
  Engine engine(small_options(), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(1000));
  engine.end_of_stream("imu");
  ASSERT_EQ(sink.samples("imu").size(), 1000U);
  for (const auto& calls : {sink.calls(), sink.realtime_calls()}) {
    EXPECT_EQ(*std::ranges::max_element(calls), kMaxModelReleaseSamples);
    EXPECT_LT(calls.size(), 40U) << "not one by one";
  }
}

TEST(EngineInRealTime, StaysSilentForAWindowMethod) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  engine.push("imu", counting_samples(200));
  engine.end_of_stream("imu");
  EXPECT_TRUE(sink.realtime_calls().empty());
  EXPECT_EQ(realtime_count(engine), 0U);
}

TEST(EngineInRealTime, UsesTheModelsThatTheLaggedOutputUsesAtTheSameMoment) {
  RecordingSink sink;
  Engine engine(small_options(2), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(320));
  const auto realtime = sink.realtime("imu");
  ASSERT_EQ(realtime.size(), 320U);
  for (std::size_t n = 0; n < realtime.size(); ++n) {
    // As in UsesAModelFromTheSampleAfterTheNextHopOn, where this sample is the one that arrives.
    const std::size_t m = n / 32 >= 1 ? n / 32 - 1 : 0;
    const double model = m == 0 ? 0.0 : 32.0 * static_cast<double>(m) - 1.0;
    EXPECT_EQ(realtime[n].rate_radps[0], static_cast<double>(n) + 1000.0 * model) << "sample " << n;
    EXPECT_EQ(realtime[n].rate_std_radps[0], std::sqrt(model * model + 1.0));
    EXPECT_EQ(realtime[n].model_epoch, m);
    EXPECT_EQ(has_flag(realtime[n], SampleFlag::kWarmingUp), n + 1 < 128) << n;
    EXPECT_FALSE(has_flag(realtime[n], SampleFlag::kTail));
  }
}

TEST(EngineInRealTime, GivesTheSameBitsForAnyWorkersAndAnyBatching) {
  const auto input = noisy_samples(1500);
  const auto run = [&input](std::size_t workers, std::size_t batch) {
    RecordingSink sink;
    Engine engine(small_options(workers), testing::last_sample_method(), sink);
    const std::span<const Sample> all{input};
    for (std::size_t n = 0; n < all.size(); n += batch)
      engine.push("imu", all.subspan(n, std::min(batch, all.size() - n)));
    engine.stop(std::chrono::seconds{60});
    return sink.realtime("imu");
  };
  const auto expected = run(0, 1);
  EXPECT_EQ(expected.size(), input.size());
  for (const std::size_t workers : {0U, 1U, 3U}) {
    for (const std::size_t batch : {1U, 7U, 1500U})
      EXPECT_TRUE(same_bits(run(workers, batch), expected)) << workers << " workers, batches of " << batch;
  }
}

TEST(EngineInRealTime, HandsOverWhatThereIsBeforeItWaitsForAWorker) {
  RecordingSink sink;
  Gatekeeper gate;
  Engine engine(small_options(1), testing::last_sample_method([&gate] { gate.pass(); }), sink);
  gate.set_open(false);
  engine.push("imu", counting_samples(32));
  gate.wait_for_entry();
  std::thread pushes([&engine] { engine.push("imu", counting_samples(40, 32)); });  // waits at sample 64
  while (sink.realtime("imu").size() < 64) std::this_thread::yield();
  EXPECT_EQ(sink.realtime("imu").size(), 64U);
  gate.set_open(true);
  pushes.join();
  EXPECT_EQ(sink.realtime("imu").size(), 72U);
}

TEST(EngineWithModels, FlagsWhatTheModelDoesNotExplainAndCountsHowOftenThatBegan) {
  RecordingSink sink;
  EngineOptions options = small_options();
  Engine engine(options, testing::last_sample_method(), sink);
  auto input = counting_samples(96);
  for (const std::size_t n : {40U, 41U, 60U}) input[n].rate_radps[1] = 2.0 * testing::kMisfit;
  engine.push("imu", input);
  const auto realtime = sink.realtime("imu");
  for (std::size_t n = 0; n < realtime.size(); ++n)
    EXPECT_EQ(has_flag(realtime[n], SampleFlag::kModelMisfit), n == 40 || n == 41 || n == 60) << n;
  const auto lagged = sink.samples("imu");
  EXPECT_TRUE(has_flag(lagged[24], SampleFlag::kModelMisfit)) << "what is released with sample 40";
  EXPECT_FALSE(has_flag(lagged[23], SampleFlag::kModelMisfit));
  EXPECT_EQ(engine.snapshot().totals.misfits, 2U);
  engine.end_of_stream("imu");
  engine.push("imu", input);
  EXPECT_EQ(engine.snapshot().totals.misfits, 4U) << "the filter counts from nought, the channel goes on";
}

TEST(EngineWithModels, ReportsTheFitAsOfTheWindowsEnd) {
  RecordingSink sink;
  Engine engine(small_options(2), testing::last_sample_method(), sink);
  auto input = counting_samples(96);
  input[63].rate_radps[1] = 2.0 * testing::kMisfit;  // the last sample of the second window
  engine.push("imu", input);
  engine.wait_idle();
  const auto reports = sink.reports("imu");
  ASSERT_EQ(reports.size(), 3U);
  for (const NoiseReport& report : reports) ASSERT_TRUE(report.model_fit.has_value());
  EXPECT_FALSE((*reports[0].model_fit)[1].misfit);
  EXPECT_TRUE((*reports[1].model_fit)[1].misfit);
  EXPECT_EQ((*reports[1].model_fit)[1].normalised_innovation, 9.0);
  EXPECT_FALSE((*reports[1].model_fit)[0].misfit);
  EXPECT_FALSE((*reports[2].model_fit)[1].misfit);
  EXPECT_EQ((*reports[2].model_fit)[1].misfits, 1U);
  const auto flagged = [](const NoiseReport& report) {
    return (report.flags & static_cast<std::uint32_t>(SampleFlag::kModelMisfit)) != 0;
  };
  EXPECT_FALSE(flagged(reports[0]));
  EXPECT_TRUE(flagged(reports[1])) << "as the samples that are released with it";
  EXPECT_FALSE(flagged(reports[2]));
}

// The toy claims 1 + last^2 for a sample, last the model's: 0 until sample 64, whose model is that of the window that ended with sample 31.
TEST(EngineWithModels, ReportsTheNoiseThatItsSamplesClaim) {
  RecordingSink sink;
  Engine engine(small_options(2), testing::last_sample_method(), sink);
  engine.push("imu", counting_samples(128));
  engine.wait_idle();
  const auto reports = sink.reports("imu");
  ASSERT_EQ(reports.size(), 4U);
  EXPECT_EQ(reports[1].axis[0].output_noise, 1.0);
  EXPECT_NEAR(reports[2].axis[0].output_noise, std::sqrt(1.0 + 31.0 * 31.0), 1e-12);
  EXPECT_NEAR(reports[3].axis[0].output_noise, std::sqrt(1.0 + 63.0 * 63.0), 1e-12);
}

TEST(Engine, ReportsNoFitOfAWindowMethodAndItsOutputNoiseAsEverySamplesDeviation) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  engine.push("imu", counting_samples(160));
  EXPECT_FALSE(sink.reports("imu").back().model_fit.has_value());
  const auto output = sink.samples("imu");
  EXPECT_THAT(output.back().rate_std_radps, Each(64.0)) << "the toy says half of the window's 128 samples";
}

}  // namespace
}  // namespace gyrod::stream
