#include "stream/hop_schedule.hpp"

#include <gtest/gtest.h>

namespace gyrod::stream {
namespace {

std::uint32_t bit(SampleFlag flag) { return static_cast<std::uint32_t>(flag); }

const HopSchedule::Options kOptions{.window = 128, .hop = 32, .max_hop = 64, .lag = 16};

TEST(HopSchedule, MakesAWindowEveryHop) {
  HopSchedule schedule(kOptions);
  int windows = 0;
  for (Position end = 1; end <= 320; ++end) {
    if (!schedule.due(end)) continue;
    EXPECT_EQ(end % 32, 0);
    static_cast<void>(schedule.take(end));
    ++windows;
  }
  EXPECT_EQ(windows, 10);
}

TEST(HopSchedule, ReleasesEveryPositionOnceAndInOrder) {
  HopSchedule schedule(kOptions);
  Position next = 0;
  for (Position end = 1; end <= 1000; ++end) {
    if (!schedule.due(end)) continue;
    const WindowJob job = schedule.take(end);
    EXPECT_EQ(job.release_begin, next);
    EXPECT_EQ(job.release_end, end - 16);
    EXPECT_LE(job.begin, job.release_begin);
    next = job.release_end;
  }
  const WindowJob tail = schedule.close(1000);
  EXPECT_EQ(tail.release_begin, next);
  EXPECT_EQ(tail.release_end, 1000);
  EXPECT_NE(tail.flags & bit(SampleFlag::kTail), 0U);
}

TEST(HopSchedule, FlagsWindowsThatAreNotFull) {
  HopSchedule schedule(kOptions);
  EXPECT_NE(schedule.take(32).flags & bit(SampleFlag::kWarmingUp), 0U);
  EXPECT_NE(schedule.take(96).flags & bit(SampleFlag::kWarmingUp), 0U);
  const WindowJob full = schedule.take(128);
  EXPECT_EQ(full.flags, 0U);
  EXPECT_EQ(full.begin, 0);
}

TEST(HopSchedule, NeverLooksBackBeyondAClosedSegment) {
  HopSchedule schedule(kOptions);
  static_cast<void>(schedule.take(96));
  static_cast<void>(schedule.close(100));
  EXPECT_FALSE(schedule.due(128)) << "hops count from the new segment's begin";
  ASSERT_TRUE(schedule.due(132));
  EXPECT_EQ(schedule.take(132).begin, 100);
}

TEST(HopSchedule, ClosesAnEmptySegmentWithAnEmptyWindow) {
  HopSchedule schedule(kOptions);
  const WindowJob tail = schedule.close(0);
  EXPECT_EQ(tail.begin, tail.end);
  EXPECT_EQ(tail.release_begin, tail.release_end);
}

TEST(HopSchedule, WidensUpToItsMaximumAndComesBack) {
  HopSchedule schedule(kOptions);
  EXPECT_TRUE(schedule.widen());
  EXPECT_FALSE(schedule.widen());
  EXPECT_EQ(schedule.hop(), 64);
  EXPECT_FALSE(schedule.due(32));
  ASSERT_TRUE(schedule.due(64));
  EXPECT_NE(schedule.take(64).flags & bit(SampleFlag::kHopWidened), 0U);
  schedule.narrow();
  EXPECT_EQ(schedule.hop(), 32);
}

TEST(HopSchedule, FlagsWhatWaitedForAWideHopAlsoWhereTheHopIsBackToNormal) {
  HopSchedule schedule(kOptions);
  static_cast<void>(schedule.take(32));
  ASSERT_TRUE(schedule.widen());
  schedule.narrow();
  EXPECT_NE(schedule.take(96).flags & bit(SampleFlag::kHopWidened), 0U) << "two hops after the window before";
  EXPECT_EQ(schedule.take(128).flags & bit(SampleFlag::kHopWidened), 0U);
}

}  // namespace
}  // namespace gyrod::stream
