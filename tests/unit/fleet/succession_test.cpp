#include "fleet/succession.hpp"

#include <cstdint>

#include <gtest/gtest.h>

namespace gyrod::fleet {
namespace {

constexpr std::int64_t kMs = 1'000'000;
/// The sensor's clock differs from ours by any amount.
constexpr std::int64_t kOffset = 1'700'000'000'000 * kMs;

std::int64_t stamp_of(std::int64_t sent_ms) { return kOffset + sent_ms * kMs; }

class Takeover : public ::testing::Test {
 protected:
  /// Watched for a second at 100 Hz, 1 ms on the way but for some that are repaired; taken over at 1000 ms.
  Takeover() {
    for (std::int64_t sent = 0; sent < 900; sent += 10)
      succession_.watch("imu", stamp_of(sent), (sent + (sent % 70 == 0 ? 90 : 1)) * kMs);
    succession_.change(1000 * kMs, [](std::string_view) { return true; });
  }
  bool left_out(std::int64_t sent_ms, std::int64_t arrives_ms) {
    return succession_.may_have_been_served("imu", stamp_of(sent_ms), arrives_ms * kMs);
  }

  Succession succession_;
};

TEST_F(Takeover, LeavesOutWhatWasSentBeforeHoweverLateItArrives) {
  EXPECT_TRUE(left_out(900, 1005));
  EXPECT_TRUE(left_out(990, 1300));
  EXPECT_TRUE(left_out(1010, 1301)) << "in doubt";
  EXPECT_TRUE(left_out(1050, 1301)) << "one in seven was 89 ms late, and a second is not long";
  EXPECT_FALSE(left_out(1100, 1302));
  EXPECT_FALSE(left_out(900, 1303)) << "the watch is over";
}

TEST_F(Takeover, EndsAfterTenSecondsWhateverTheStampsSay) {
  EXPECT_TRUE(left_out(900, 11000));
  EXPECT_FALSE(left_out(900, 11001));
}

TEST_F(Takeover, CountsFromWhenItWasTakenNotFromLaterChanges) {
  succession_.change(1500 * kMs, [](std::string_view) { return true; });
  EXPECT_FALSE(left_out(1100, 1501));
}

TEST_F(Takeover, BeginsAgainWhenItWasGivenUpInBetween) {
  succession_.change(1500 * kMs, [](std::string_view) { return false; });
  succession_.change(1600 * kMs, [](std::string_view) { return true; });
  EXPECT_TRUE(left_out(1590, 1601));
  EXPECT_FALSE(left_out(1700, 1701));
}

TEST(Succession, AClockOfAnotherPaceIsFollowed) {
  // A day at 100 Hz of a clock that is slow by 100 ppm: 8.6 s behind in the end, 6 ms within the memory.
  constexpr std::int64_t kDayMs = 86'400'000;
  const auto slow_stamp = [](std::int64_t sent_ms) { return kOffset + sent_ms * kMs - sent_ms * 100; };
  Succession succession;
  for (std::int64_t sent = 0; sent < kDayMs; sent += 1000)
    succession.watch("imu", slow_stamp(sent), sent * kMs);
  succession.change(kDayMs * kMs, [](std::string_view) { return true; });
  EXPECT_TRUE(succession.may_have_been_served("imu", slow_stamp(kDayMs - 10), (kDayMs + 2000) * kMs));
  EXPECT_FALSE(succession.may_have_been_served("imu", slow_stamp(kDayMs + 40), (kDayMs + 2001) * kMs));
}

// The other daemon took it 1 ms after it was sent, and served it; here something before it was always missing, for 60 to 160 ms.
TEST(Succession, WhereNothingComesWithoutDelayMoreIsLeftOut) {
  Succession succession;
  for (std::int64_t sent = 0; sent < 900; sent += 10)
    succession.watch("imu", stamp_of(sent), (sent + 60 + sent % 110) * kMs);
  succession.change(1000 * kMs, [](std::string_view) { return true; });
  EXPECT_TRUE(succession.may_have_been_served("imu", stamp_of(995), 1100 * kMs));
  EXPECT_FALSE(succession.may_have_been_served("imu", stamp_of(1100), 1200 * kMs));
}

TEST(Succession, ASensorThatWasHardlySeenMayHaveBeenHeldUp) {
  Succession succession;
  for (std::int64_t sent = 900; sent < 940; sent += 10) succession.watch("imu", stamp_of(sent), 990 * kMs);
  succession.change(1000 * kMs, [](std::string_view) { return true; });
  EXPECT_TRUE(succession.may_have_been_served("imu", stamp_of(995), 1100 * kMs));
  EXPECT_TRUE(succession.may_have_been_served("imu", stamp_of(1100), 1150 * kMs));
  EXPECT_FALSE(succession.may_have_been_served("imu", stamp_of(1200), 1250 * kMs));
}

TEST(Succession, OfASensorThatNobodyElseServedLeavesOutNothing) {
  Succession succession;
  EXPECT_FALSE(succession.may_have_been_served("imu", stamp_of(0), 0));
  succession.watch("other", stamp_of(0), 0);
  succession.change(1, [](std::string_view) { return true; });
  EXPECT_FALSE(succession.may_have_been_served("imu", stamp_of(0), 2));
}

TEST(Succession, TakesAnyStamp) {
  Succession succession;
  for (const std::int64_t stamp : {INT64_MIN, INT64_MAX, std::int64_t{0}}) {
    succession.watch("imu", stamp, 5);
    succession.change(6, [](std::string_view) { return true; });
    (void)succession.may_have_been_served("imu", stamp, 7);
  }
}

}  // namespace
}  // namespace gyrod::fleet
