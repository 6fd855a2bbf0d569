#include "live/sample_trail.hpp"

#include <atomic>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "live/rest_trail.hpp"

namespace gyrod::live {
namespace {

void add(SampleTrail& trail, std::int64_t stamp_ns) {
  const auto value = static_cast<double>(stamp_ns);
  trail.add(stamp_ns, {value, 2.0 * value, 3.0 * value});
}

std::vector<Point> all_of(const SampleTrail& trail) {
  std::vector<Point> points;
  (void)trail.read(0, points);
  return points;
}

TEST(SampleTrail, KeepsTheNewestInOrder) {
  SampleTrail trail(8);
  for (std::int64_t stamp = 1; stamp <= 20; ++stamp) add(trail, stamp);
  const auto points = all_of(trail);
  ASSERT_EQ(points.size(), 8U);
  EXPECT_EQ(points.front().stamp_ns, 13);
  EXPECT_EQ(points.back().stamp_ns, 20);
  EXPECT_EQ(points.back().rate_radps[2], 60.0F);
}

TEST(SampleTrail, ReadsOnFromWhereItWasLeft) {
  SampleTrail trail(8);
  std::vector<Point> points;
  for (std::int64_t stamp = 1; stamp <= 3; ++stamp) add(trail, stamp);
  const std::uint64_t place = trail.read(0, points);
  for (std::int64_t stamp = 4; stamp <= 5; ++stamp) add(trail, stamp);
  EXPECT_EQ(trail.read(place, points), 5U);
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(points[3].stamp_ns, 4);
}

TEST(SampleTrail, PassesOverWhatIsNoSample) {
  SampleTrail trail(8);
  trail.add(1, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  trail.add(2, {0.0, 1e300, 0.0});
  add(trail, 5);
  add(trail, 5);
  add(trail, 4);
  EXPECT_EQ(all_of(trail).size(), 1U);
}

TEST(SampleTrail, BeginsAnewWhereTheClockGoesBack) {
  SampleTrail trail(8);
  add(trail, SampleTrail::kClockStepNs + 2);
  add(trail, 1);
  add(trail, 2);
  const auto points = all_of(trail);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.front().stamp_ns, 1);
}

// The shape of a race: whatever is read is in order, without holes, and no point is of two samples.
TEST(SampleTrail, WhoReadsWhileItIsWrittenGetsWholePointsInOrder) {
  constexpr std::int64_t kSamples = 200'000;
  SampleTrail trail(64);
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::int64_t stamp = 1; stamp <= kSamples; ++stamp) {
      trail.add(stamp, {static_cast<double>(stamp), static_cast<double>(-stamp), 1.0});
    }
    done = true;
  });
  std::size_t wrong = 0;
  std::vector<Point> points;
  while (!done) {
    points.clear();
    (void)trail.read(0, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto expected = static_cast<float>(points[i].stamp_ns);
      if (points[i].rate_radps[0] != expected || points[i].rate_radps[1] != -expected) ++wrong;
      if (i > 0 && points[i].stamp_ns != points[i - 1].stamp_ns + 1) ++wrong;
    }
  }
  writer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(all_of(trail).size(), 64U);
}

TEST(RestTrail, JoinsReportsToIntervals) {
  RestTrail rests;
  rests.note(10, false);
  rests.note(20, true);
  rests.note(30, true);
  rests.note(40, false);
  rests.note(50, true);
  EXPECT_EQ(rests.since(0), (std::vector<Interval>{{10, 30}, {40, 50}}));
  EXPECT_EQ(rests.since(30), (std::vector<Interval>{{40, 50}}));
}

TEST(RestTrail, KeepsABoundedNumber) {
  RestTrail rests;
  for (std::int64_t i = 0; i < 1000; ++i) rests.note(i, i % 2 == 0);
  EXPECT_EQ(rests.since(-1).size(), RestTrail::kMost);
  EXPECT_EQ(rests.since(-1).back().end_ns, 998);
}

}  // namespace
}  // namespace gyrod::live
