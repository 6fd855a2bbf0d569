#include "stream/engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

TEST(Engine, NamesAnOptionOutsideItsRange) {
  RecordingSink sink;
  EngineOptions options = small_options();
  options.hop_samples = 100;
  try {
    Engine engine(options, window_marker(), sink);
    FAIL() << "accepted a hop of 100 for a window of 128";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "hop_samples is 100, expected 1 to 64");
  }
}

TEST(Engine, NamesALagThatIsTooLongForAModelMethod) {
  RecordingSink sink;
  EngineOptions options = small_options();
  options.window_samples = 256;
  options.lag_samples = 33;
  EXPECT_NO_THROW(Engine(options, window_marker(), sink));
  try {
    Engine engine(options, testing::last_sample_method(), sink);
    FAIL() << "accepted a lag of 33";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "lag_samples is 33, expected 0 to 32");
  }
}

TEST(Engine, ReleasesEverySampleOnceInOrderWithItsOwnStamp) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  const auto input = counting_samples(1000, 7);
  engine.push("imu", input);
  engine.end_of_stream("imu");
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), input.size());
  for (std::size_t n = 0; n < input.size(); ++n) {
    EXPECT_EQ(output[n].sequence, input[n].sequence);
    EXPECT_EQ(output[n].stamp_ns, input[n].stamp_ns);
  }
  expect_conserved(engine.snapshot().totals);
  EXPECT_EQ(engine.snapshot().totals.in_flight, 0U);
}

TEST(Engine, TellsTheEndOfASensorOnceAfterTheLastOfItsSamples) {
  for (const std::size_t workers : {0U, 2U}) {
    for (const auto& method :
         {MethodFactory{window_marker()}, MethodFactory{testing::last_sample_method()}}) {
      RecordingSink sink;
      Engine engine(small_options(workers), method, sink);
      engine.push("imu", counting_samples(1000));
      engine.end_of_stream("imu");
      engine.end_of_stream("imu");  // nothing came since: no news
      engine.wait_idle();
      EXPECT_EQ(sink.ended_after("imu"), std::vector<std::size_t>{1000});
    }
  }
}

TEST(Engine, TellsTheEndBeforeSamplesOfTheNextStream) {
  for (const auto& method : {MethodFactory{window_marker()}, MethodFactory{testing::last_sample_method()}}) {
    RecordingSink sink;
    Engine engine(small_options(1), method, sink);
    engine.push("imu", counting_samples(40));
    engine.end_of_stream("imu");
    engine.push("imu", counting_samples(30, 40));
    engine.stop(std::chrono::seconds{60});
    EXPECT_EQ(sink.ended_after("imu"), std::vector<std::size_t>{40});
    EXPECT_EQ(sink.samples("imu").size(), 70U);
  }
}

TEST(Engine, AnswersHowManySamplesItAccepted) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  EXPECT_EQ(engine.push("imu", counting_samples(10)), 10U);
  EXPECT_EQ(engine.push("imu", counting_samples(12, 7)), 9U) << "three duplicates";
  EXPECT_EQ(engine.push("", counting_samples(3)), 0U);
}

TEST(Engine, HoldsBackNoMoreThanLagAndHop) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  for (const Sample& sample : counting_samples(1000)) {
    engine.push("imu", {&sample, 1});
    EXPECT_LT(engine.snapshot().totals.in_flight, 32U + 16U);
    expect_conserved(engine.snapshot().totals);
  }
}

TEST(Engine, DenoisesOnWhatThereIsBeforeTheWindowIsFull) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  engine.push("imu", counting_samples(160));
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 144U);
  const auto warming = static_cast<std::uint32_t>(SampleFlag::kWarmingUp);
  EXPECT_EQ(output[0].flags, warming);
  EXPECT_NEAR(output[0].rate_radps[0], 0.0 + 0.032, 1e-4) << "made from a window of 32";
  EXPECT_EQ(output[79].flags, warming);
  EXPECT_EQ(output[80].flags, 0U) << "the first full window ends at 128 and releases from 96 - 16 on";
  EXPECT_GT(output[79].rate_radps[0], 79.0 + 0.095) << "as the window of 96 has it, which fades into";
  EXPECT_LT(output[80].rate_radps[0], 80.0 + 0.097);
  EXPECT_NEAR(output[92].rate_radps[0], 92.0 + 0.128, 1e-3) << "that of 128 within 12 samples";
}

TEST(Engine, GivesTheSameBitsForAnyWorkersAndAnyBatching) {
  const auto input = noisy_samples(3000);
  const auto run = [&input](std::size_t workers, std::size_t batch) {
    RecordingSink sink;
    Engine engine(small_options(workers), paper_method({}), sink);
    for (std::size_t n = 0; n < input.size(); n += batch) {
      engine.push("imu", std::span{input}.subspan(n, std::min(batch, input.size() - n)));
    }
    engine.end_of_stream("imu");
    engine.wait_idle();
    return sink.samples("imu");
  };
  const auto expected = run(0, 3000);
  ASSERT_EQ(expected.size(), input.size());
  for (const std::size_t workers : {0U, 1U, 2U, 4U}) {
    for (const std::size_t batch : {1U, 7U, 64U}) {
      EXPECT_TRUE(same_bits(run(workers, batch), expected)) << workers << " workers, batches of " << batch;
    }
  }
}

TEST(Engine, KeepsSensorsApart) {
  RecordingSink sink;
  Engine engine(small_options(2), paper_method({}), sink);
  const auto a = noisy_samples(2000, 1);
  const auto b = noisy_samples(2000, 2);
  for (std::size_t n = 0; n < a.size(); n += 10) {
    engine.push("a", std::span{a}.subspan(n, 10));
    engine.push("b", std::span{b}.subspan(n, 10));
  }
  engine.stop(std::chrono::seconds{60});
  RecordingSink alone;
  Engine single(small_options(0), paper_method({}), alone);
  single.push("b", b);
  single.end_of_stream("b");
  EXPECT_TRUE(same_bits(sink.samples("b"), alone.samples("b")));
}

}  // namespace
}  // namespace gyrod::stream
