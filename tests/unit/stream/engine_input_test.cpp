#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

TEST(Engine, BridgesAShortGapWithoutPublishingIt) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  engine.push("imu", counting_samples(100));
  engine.push("imu", counting_samples(100, 103));
  engine.end_of_stream("imu");
  const auto numbers = sequences(sink.samples("imu"));
  EXPECT_EQ(numbers.size(), 200U);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 101U), 0);
  const Counts counts = engine.snapshot().totals;
  EXPECT_EQ(counts.missing, 3U);
  EXPECT_EQ(counts.bridged, 3U);
  EXPECT_EQ(counts.gaps, 0U);
  expect_conserved(counts);
}

TEST(Engine, OpensANewWindowAfterALongGapAndLosesNothing) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  engine.push("imu", counting_samples(200));
  engine.push("imu", counting_samples(200, 200 + 10 * 128));
  engine.end_of_stream("imu");
  const auto output = sink.samples("imu");
  ASSERT_EQ(output.size(), 400U);
  EXPECT_NE(output[199].flags & static_cast<std::uint32_t>(SampleFlag::kTail), 0U);
  EXPECT_NE(output[200].flags & static_cast<std::uint32_t>(SampleFlag::kWarmingUp), 0U);
  const Counts counts = engine.snapshot().totals;
  EXPECT_EQ(counts.gaps, 1U);
  EXPECT_EQ(counts.missing, 1280U);
}

TEST(Engine, PassesThroughWhatIsTooShortToDecompose) {
  for (std::uint64_t count = 1; count <= 8; ++count) {
    RecordingSink sink;
    Engine engine(small_options(), paper_method({}), sink);
    const auto input = counting_samples(count);
    engine.push("imu", input);
    engine.end_of_stream("imu");
    const auto output = sink.samples("imu");
    ASSERT_EQ(output.size(), count);
    for (std::size_t n = 0; n < count; ++n) {
      EXPECT_EQ(output[n].rate_radps, input[n].rate_radps);
      EXPECT_NE(output[n].flags & static_cast<std::uint32_t>(SampleFlag::kPassThrough), 0U);
    }
  }
}

TEST(Engine, RefusesAFloodOfNewSensorsAndCountsIt) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  const Sample sample = sample_at(0);
  for (int id = 0; id < 10'000; ++id) engine.push("sensor-" + std::to_string(id), {&sample, 1});
  const EngineSnapshot snapshot = engine.snapshot();
  EXPECT_EQ(snapshot.channels, 8U);
  EXPECT_EQ(snapshot.totals.received, 10'000U);
  EXPECT_EQ(snapshot.totals.rejected[static_cast<std::size_t>(RejectReason::kTooManyChannels)], 9'992U);
  expect_conserved(snapshot.totals);
}

TEST(Engine, RefusesIdsThatAreEmptyLongOrNotPrintable) {
  RecordingSink sink;
  Engine engine(small_options(), window_marker(), sink);
  const Sample sample = sample_at(0);
  for (const std::string& id :
       {std::string{}, std::string(65, 'x'), std::string{"a\nb"}, std::string{"\xff"}}) {
    engine.push(id, {&sample, 1});
  }
  const Counts counts = engine.snapshot().totals;
  EXPECT_EQ(counts.rejected[static_cast<std::size_t>(RejectReason::kBadSensorId)], 4U);
  expect_conserved(counts);
}

TEST(Engine, StaysFiniteAndConservedOnHostileValues) {
  const auto constant = [](std::uint64_t n) { return sample_at(n, 0.25); };
  const auto zero = [](std::uint64_t n) { return sample_at(n, 0.0); };
  const auto plateaus = [](std::uint64_t n) { return sample_at(n, 0.01 * static_cast<double>((n / 7) % 3)); };
  const auto spike = [](std::uint64_t n) {
    return sample_at(n, n == 300 ? 174.0 : 1e-3 * static_cast<double>(n % 2));
  };
  const auto tiny = [](std::uint64_t n) { return sample_at(n, 1e-310 * static_cast<double>(n % 5)); };
  using Make = std::function<Sample(std::uint64_t)>;
  for (const Make& make : {Make{constant}, Make{zero}, Make{plateaus}, Make{spike}, Make{tiny}}) {
    RecordingSink sink;
    Engine engine(small_options(), paper_method({}), sink);
    for (std::uint64_t n = 0; n < 1000; ++n) {
      const Sample sample = make(n);
      engine.push("imu", {&sample, 1});
    }
    engine.end_of_stream("imu");
    const auto output = sink.samples("imu");
    ASSERT_EQ(output.size(), 1000U);
    for (const DenoisedSample& sample : output) {
      for (const double rate : sample.rate_radps) ASSERT_TRUE(std::isfinite(rate));
    }
  }
}

TEST(Engine, LeavesAConstantAsItIs) {
  RecordingSink sink;
  Engine engine(small_options(), paper_method({}), sink);
  for (std::uint64_t n = 0; n < 500; ++n) {
    const Sample sample = sample_at(n, 0.25);
    engine.push("imu", {&sample, 1});
  }
  engine.end_of_stream("imu");
  ASSERT_EQ(sink.samples("imu").size(), 500U);
  for (const DenoisedSample& sample : sink.samples("imu")) EXPECT_EQ(sample.rate_radps[0], 0.25);
}

}  // namespace
}  // namespace gyrod::stream
