// What a tick of all of it makes of an engine.
#include "live/live.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recording_sink.hpp"
#include "support/samples.hpp"
#include "support/toy_methods.hpp"

namespace gyrod::live {
namespace {

using ::testing::HasSubstr;

TEST(Live, AModelThatHasNotFittedForAMinuteIsAnEventAndTwoLinesForTheLog) {
  testing::RecordingSink sink;
  stream::EngineOptions options;
  options.window_samples = 64;
  options.hop_samples = 32;
  options.max_hop_samples = 32;
  options.lag_samples = 16;
  options.workers = 0;
  options.max_rate_radps = 1e6;
  stream::Engine engine(options, testing::last_sample_method(), sink);
  Live live;
  double now_s = 0.0;
  std::uint64_t sequence = 0;
  const auto minutes = [&](double rate, int count) {
    std::vector<FitWatch::News> all;
    for (const double end_s = now_s + 60.0 * count; now_s < end_s; now_s += 1.0) {
      for (int n = 0; n < 32; ++n) engine.push("front", std::vector{testing::sample_at(sequence++, rate)});
      for (auto& news : live.tick(now_s, 1.7e9 + now_s, engine)) all.push_back(std::move(news));
    }
    return all;
  };
  EXPECT_EQ(minutes(0.0, 3).size(), 0U);
  const auto begun = minutes(2.0 * testing::kMisfit, 5);
  const auto over = minutes(0.0, 5);
  ASSERT_EQ(begun.size(), 1U);
  ASSERT_EQ(over.size(), 1U);
  EXPECT_THAT(begun[0].text, HasSubstr("front axis x: the model has not fitted for a minute"));
  const auto events = live.events.read({.sensor = "front"}).events;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, begun[0].text + ".");
  EXPECT_EQ(events[1].text, over[0].text + ".");
  EXPECT_GE(events[0].time_s, 1.7e9 + 180.0 + 60.0);
  EXPECT_LT(events[0].time_s, 1.7e9 + 180.0 + 90.0);
}

}  // namespace
}  // namespace gyrod::live
