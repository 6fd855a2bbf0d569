#include "live/tap.hpp"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"

namespace gyrod::live {
namespace {

std::vector<stream::Sample> samples(std::size_t count, std::int64_t first_ns = 1) {
  std::vector<stream::Sample> made(count);
  for (std::size_t i = 0; i < count; ++i) made[i].stamp_ns = first_ns + static_cast<std::int64_t>(i);
  return made;
}

TEST(Tap, KeepsSamplesOfThoseThatAreLookedAtOnly) {
  Tap tap;
  tap.on_raw("imu", samples(10));
  const auto watched = tap.look("imu", 100.0, 0.0);
  EXPECT_EQ(watched->raw.end(), 0U);
  tap.on_raw("imu", samples(3));
  tap.on_raw("other", samples(5));
  EXPECT_EQ(watched->raw.end(), 3U);
  EXPECT_EQ(watched->denoised.end(), 0U);
  EXPECT_EQ(tap.look("imu", 100.0, 1.0), watched) << "the second look is of the same";
}

TEST(Tap, LetsGoAMinuteAfterTheLastLook) {
  Tap tap;
  const std::weak_ptr<const Watched> watched = tap.look("imu", 100.0, 0.0);
  (void)tap.look("imu", 100.0, 30.0);
  tap.tidy(89.0);
  EXPECT_FALSE(watched.expired());
  tap.tidy(90.0);
  EXPECT_TRUE(watched.expired());
  tap.on_raw("imu", samples(3));
  EXPECT_EQ(tap.look("imu", 100.0, 91.0)->raw.end(), 0U);
}

TEST(Tap, WhoStillReadsKeepsWhatIsLetGo) {
  Tap tap;
  const auto watched = tap.look("imu", 100.0, 0.0);
  tap.tidy(100.0);
  tap.on_raw("imu", samples(3));
  EXPECT_EQ(watched->raw.end(), 0U);
}

TEST(Tap, HasRoomForSixteen) {
  Tap tap;
  for (std::size_t i = 0; i < Tap::kMost; ++i) EXPECT_NE(tap.look(std::to_string(i), 1.0, 0.0), nullptr);
  EXPECT_EQ(tap.look("one more", 1.0, 0.0), nullptr);
  EXPECT_NE(tap.look("0", 1.0, 59.0), nullptr);
  tap.tidy(60.0);
  EXPECT_NE(tap.look("one more", 1.0, 60.0), nullptr);
}

TEST(Tap, KeepsNoMoreThanItsBoundOfAFastSensor) {
  Tap tap;
  const auto watched = tap.look("imu", 1e6, 0.0);
  tap.on_raw("imu", samples(Tap::kMostSamples + 5));
  std::vector<Point> points;
  (void)watched->raw.read(0, points);
  EXPECT_EQ(points.size(), Tap::kMostSamples);
}

TEST(Tap, NotesRestsAsReportsTellThem) {
  Tap tap;
  const auto watched = tap.look("imu", 100.0, 0.0);
  stream::NoiseReport report;
  report.last_stamp_ns = 10;
  tap.on_report("imu", report);  // nobody knows
  report.at_rest = false;
  tap.on_report("imu", report);
  report.last_stamp_ns = 20;
  report.at_rest = true;
  tap.on_report("imu", report);
  EXPECT_EQ(watched->rests.since(0), (std::vector<Interval>{{10, 20}}));
}

TEST(Tap, TheSamplesThreadAllocatesNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  Tap tap;
  const auto watched = tap.look("imu", 100.0, 0.0);
  const auto raw = samples(1000);
  const std::vector<stream::DenoisedSample> denoised(10);
  stream::NoiseReport report;
  report.at_rest = true;
  const std::uint64_t before = testing::allocations();
  tap.on_raw("imu", raw);
  tap.on_raw("nobody looks", raw);
  tap.on_denoised("imu", denoised);
  tap.on_report("imu", report);
  EXPECT_EQ(testing::allocations(), before);
}

// Two threads of samples, one that looks and lets go all the time: for the thread sanitizer, and to see that nobody hangs.
TEST(Tap, CanBeLookedAtAndLetGoWhileSamplesCome) {
  constexpr int kRounds = 300;
  Tap tap;
  std::atomic<bool> done{false};
  std::thread raw([&] {
    for (std::int64_t stamp = 1; !done; stamp += 100) tap.on_raw("imu", samples(100, stamp));
  });
  std::thread denoised([&] {
    std::vector<stream::DenoisedSample> some(10);
    for (std::int64_t stamp = 1; !done; ++stamp) {
      for (auto& sample : some) sample.stamp_ns = ++stamp;
      tap.on_denoised("imu", some);
    }
  });
  for (int round = 0; round < kRounds; ++round) {
    const auto watched = tap.look("imu", 10.0, 0.0);
    std::vector<Point> points;
    (void)watched->raw.read(0, points);
    (void)watched->denoised.read(0, points);
    tap.tidy(1000.0);
  }
  done = true;
  raw.join();
  denoised.join();
  EXPECT_NE(tap.look("imu", 10.0, 0.0), nullptr);
}

}  // namespace
}  // namespace gyrod::live
