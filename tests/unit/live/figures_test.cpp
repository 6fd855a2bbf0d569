/// Rates and quantiles of the last seconds, and the noise of the last minutes.
#include <string>

#include <gtest/gtest.h>

#include "live/noise_history.hpp"
#include "live/recent.hpp"

namespace gyrod::live {
namespace {

TEST(Quantile, IsInterpolatedWithinItsBucket) {
  stream::TimeHistogram times;
  EXPECT_FALSE(quantile(times, 0.5).has_value());
  for (int i = 0; i < 4; ++i) times.add(0.0015);  // the bucket from 1 ms to 2 ms
  EXPECT_DOUBLE_EQ(*quantile(times, 0.5), 0.0015);
  EXPECT_DOUBLE_EQ(*quantile(times, 1.0), 0.002);
  for (int i = 0; i < 4; ++i) times.add(60.0);
  EXPECT_DOUBLE_EQ(*quantile(times, 0.25), 0.0015);
  EXPECT_DOUBLE_EQ(*quantile(times, 0.99), 5.0) << "the last bucket has no end";
}

TEST(Recent, RatesAreOfTheLastTenSecondsAndTimesOfTheLastMinute) {
  Recent recent;
  stream::EngineSnapshot engine;
  EXPECT_FALSE(recent.figures().samples_per_s.has_value());
  engine.window_time.add(4.0);  // before anything was noted: not of the last minute
  for (int second = 0; second <= 200; ++second) {
    recent.note(second, engine);
    engine.totals.received += second < 180 ? 1000U : 50U;
    engine.totals.windows += 3;
    engine.window_time.add(0.0015);
  }
  EXPECT_DOUBLE_EQ(*recent.figures().samples_per_s, 50.0);
  EXPECT_DOUBLE_EQ(*recent.figures().windows_per_s, 3.0);
  EXPECT_EQ(recent.figures().window_time.count, 60U);
}

TEST(Recent, IsNotFooledByAClockThatStands) {
  Recent recent;
  recent.note(5.0, {});
  recent.note(5.0, {});
  EXPECT_FALSE(recent.figures().samples_per_s.has_value());
}

stream::ChannelSnapshot sensor(const std::string& name, double noise) {
  stream::ChannelSnapshot made;
  made.sensor = name;
  for (auto& axis : made.last_report.axis) axis.noise_floor = noise;
  return made;
}

TEST(NoiseHistory, KeepsTheLastSixtyOldestFirst) {
  NoiseHistory history;
  for (int i = 1; i <= 70; ++i) {
    history.note(sensor("imu", i));
    history.end_round();
  }
  const auto points = history.of("imu");
  ASSERT_EQ(points.size(), NoiseHistory::kPoints);
  EXPECT_EQ(points.front()[0], 11.0F);
  EXPECT_EQ(points.back()[2], 70.0F);
  EXPECT_EQ(history.rounds(), 70U);
}

TEST(NoiseHistory, ForgetsWhoIsNotNotedAnyMore) {
  NoiseHistory history;
  history.note(sensor("gone", 1.0));
  history.note(sensor("here", 1.0));
  history.end_round();
  history.note(sensor("here", 2.0));
  history.end_round();
  EXPECT_TRUE(history.of("gone").empty());
  EXPECT_EQ(history.of("here").size(), 2U);
}

}  // namespace
}  // namespace gyrod::live
