#include "stream/hop_schedule.hpp"

#include <limits>
#include <utility>
#include <vector>

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

/// Where windows end up to `last`, and where each began.
std::vector<std::pair<Position, Position>> windows_of(HopSchedule& schedule, Position last,
                                                      unsigned doublings) {
  std::vector<std::pair<Position, Position>> windows;
  for (Position end = 1; end <= last; ++end) {
    if (!schedule.at_boundary(end) || !schedule.due(end)) continue;
    if (schedule.doublings() < doublings && schedule.can_double(end)) schedule.double_windows(end);
    const WindowJob job = schedule.take(end);
    EXPECT_EQ(job.flags & bit(SampleFlag::kHopWidened), 0U) << end;
    EXPECT_EQ(job.hop_samples, schedule.step()) << end;
    windows.emplace_back(job.begin, job.end);
  }
  return windows;
}

using Ends = std::vector<std::pair<Position, Position>>;

TEST(HopSchedule, WindowsDoubleOnceTheyAreFullAndHopsOneDoublingLater) {
  HopSchedule schedule(kOptions);
  EXPECT_EQ(windows_of(schedule, 640, 2), (Ends{{0, 32},
                                                {0, 64},
                                                {0, 96},
                                                {0, 128},
                                                {0, 160},
                                                {0, 192},
                                                {0, 224},
                                                {0, 256},
                                                {0, 320},
                                                {0, 384},
                                                {0, 448},
                                                {0, 512},
                                                {64, 576},
                                                {128, 640}}));
  EXPECT_EQ(schedule.oldest_needed(700), 188);
  EXPECT_TRUE(schedule.widen());
  EXPECT_EQ(schedule.hop(), 128) << "twice the step, as configured";
  static_cast<void>(schedule.close(700));
  EXPECT_EQ(schedule.window(), 128) << "the next segment begins as the first one did";
  EXPECT_EQ(schedule.hop(), 64) << "still widened";
}

TEST(HopSchedule, AWindowThatIsNoMultipleOfTheNextStepWaitsForOne) {
  HopSchedule schedule({.window = 100, .hop = 20, .max_hop = 40, .lag = 16});
  static_cast<void>(windows_of(schedule, 180, 1));
  EXPECT_EQ(schedule.window(), 200);
  EXPECT_FALSE(schedule.can_double(180)) << "not full";
  EXPECT_TRUE(schedule.can_double(200));
  EXPECT_FALSE(schedule.can_double(220)) << "no whole number of hops of 40";
  EXPECT_TRUE(schedule.can_double(240));
}

TEST(HopSchedule, WindowsThatDoubleLateGrowByWhatComes) {
  HopSchedule schedule(kOptions);
  static_cast<void>(windows_of(schedule, 640, 0));
  ASSERT_TRUE(schedule.can_double(672));
  schedule.double_windows(672);
  EXPECT_EQ(schedule.take(672).begin, 544) << "as long as it was";
  EXPECT_EQ(schedule.oldest_needed(700), 544);
  EXPECT_FALSE(schedule.can_double(768)) << "not full yet";
  EXPECT_TRUE(schedule.can_double(832)) << "256 positions from 544 on, and a whole number of hops of 64";
  EXPECT_EQ(schedule.oldest_needed(832), 576);
}

TEST(HopSchedule, AWidenedHopStaysAsManySteps) {
  HopSchedule schedule(kOptions);
  static_cast<void>(windows_of(schedule, 256, 1));
  ASSERT_TRUE(schedule.widen());
  ASSERT_TRUE(schedule.can_double(320));
  schedule.double_windows(320);
  EXPECT_EQ(schedule.step(), 64);
  EXPECT_EQ(schedule.hop(), 128);
  schedule.shorten_windows(0, 320);
  EXPECT_EQ(schedule.hop(), 64);
  EXPECT_TRUE(schedule.widened());
}

TEST(HopSchedule, WindowsThatAreShortenedGoOnAtOnceAndNothingHasWaited) {
  HopSchedule schedule(kOptions);
  static_cast<void>(windows_of(schedule, 640, 2));
  ASSERT_TRUE(schedule.due(704));
  schedule.shorten_windows(0, 704);
  const WindowJob job = schedule.take(704);
  EXPECT_EQ(job.begin, 576);
  EXPECT_EQ(job.flags, 0U);
  EXPECT_TRUE(schedule.due(736));
}

TEST(HopSchedule, TheSensorsOfAFamilyStayOnTheirSide) {
  for (const double slow : {0.0, 50.0, 100.0, 120.0, 200.0, 208.0 * 1.03})
    EXPECT_EQ(doublings_at(slow, 1024), 0U) << slow;
  for (const double fast : {225.0 * 0.97, 250.0, 286.0, 400.0, 416.0 * 1.03})
    EXPECT_EQ(doublings_at(fast, 1024), 1U) << fast;
  for (const double faster : {450.0 * 0.97, 500.0, 800.0, 1000.0, 2000.0, 1e6})
    EXPECT_EQ(doublings_at(faster, 1024), 2U) << faster;
  EXPECT_EQ(doublings_at(1000.0, 32'768), 1U) << "no longer than the longest";
  EXPECT_EQ(doublings_at(1000.0, kLongestWindow), 0U);
  EXPECT_EQ(doublings_at(std::numeric_limits<double>::quiet_NaN(), 1024), 0U);
}

TEST(SampleRing, HoldsWhatItHeldWhenItGrows) {
  SampleRing ring(8);
  for (std::uint64_t n = 0; n < 13; ++n)
    ring.append({n, static_cast<std::int64_t>(10 * n), {1.0 * static_cast<double>(n), 2.0, 3.0}}, n % 2 == 0);
  ring.grow(20);
  ASSERT_EQ(ring.capacity(), 20U);
  ASSERT_EQ(ring.end(), 13);
  ring.append({13, 130, {13.0, 2.0, 3.0}}, false);
  for (Position n = 5; n < 14; ++n) {
    EXPECT_EQ(ring.at(n).sequence, static_cast<std::uint64_t>(n));
    EXPECT_EQ(ring.at(n).stamp_ns, 10 * n);
    EXPECT_EQ(ring.at(n).rate_radps[0], static_cast<double>(n));
    EXPECT_EQ(ring.released(n), n % 2 == 0);
  }
  ring.grow(10);
  EXPECT_EQ(ring.capacity(), 20U) << "never shrinks";
}

}  // namespace
}  // namespace gyrod::stream
