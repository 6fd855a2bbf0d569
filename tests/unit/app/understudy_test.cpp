#include "app/understudy.hpp"

#include <algorithm>
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::app {
namespace {

using ::testing::ElementsAre;

constexpr std::int64_t kMs = 1'000'000;

stream::Sample sample(std::uint64_t sequence) {
  return {.sequence = sequence, .stamp_ns = static_cast<std::int64_t>(sequence) * 10 * kMs};
}

bool all(std::string_view /*sensor*/) { return true; }

class UnderstudyTest : public ::testing::Test {
 protected:
  void follow(std::string_view sensor, std::uint64_t sequence, std::int64_t now_ms) {
    const stream::Sample one = sample(sequence);
    understudy_.follow(sensor, {&one, 1}, now_ms * kMs);
  }
  /// @pre something is kept of one sensor alone
  std::vector<std::uint64_t> taken(std::int64_t now_ms) {
    const auto parts = understudy_.take(all, now_ms * kMs);
    EXPECT_EQ(parts.size(), 1U);
    std::vector<std::uint64_t> sequences;
    std::ranges::transform(parts.at(0).samples, std::back_inserter(sequences), &stream::Sample::sequence);
    return sequences;
  }
  [[nodiscard]] std::uint64_t marked(std::string_view sensor, std::int64_t now_ms) {
    const auto mark = understudy_.take_mark(sensor, now_ms * kMs);
    return mark ? mark->sequence : 0;
  }

  Understudy understudy_;
};

TEST_F(UnderstudyTest, GivesOutWhatCameInTheLastThreeSecondsOnce) {
  follow("imu", 1, 0);
  follow("imu", 2, 1000);
  follow("imu", 3, 3900);
  EXPECT_THAT(taken(4000), ElementsAre(2, 3));
  EXPECT_TRUE(understudy_.take(all, 4000 * kMs).empty());
}

TEST_F(UnderstudyTest, GivesOutOnlyWhatIsServedNow) {
  follow("mine", 1, 0);
  follow("theirs", 1, 0);
  const auto mine = [](std::string_view sensor) { return sensor == "mine"; };
  const auto parts = understudy_.take(mine, kMs);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].sensor, "mine");
  understudy_.drop(mine);
  EXPECT_THAT(taken(2), ElementsAre(1)) << "the other one is kept";
}

TEST_F(UnderstudyTest, KeepsNoLongerWhatItDrops) {
  follow("imu", 1, 0);
  understudy_.drop(all);
  EXPECT_TRUE(understudy_.take(all, kMs).empty());
}

TEST_F(UnderstudyTest, TellsThatASensorHasEndedUnlessItIsBack) {
  follow("imu", 1, 0);
  understudy_.end("imu");
  understudy_.end("unknown");
  EXPECT_TRUE(understudy_.take(all, kMs).at(0).ended);
  follow("imu", 2, 2);
  understudy_.end("imu");
  follow("imu", 3, 3);
  EXPECT_FALSE(understudy_.take(all, 4 * kMs).at(0).ended);
}

TEST_F(UnderstudyTest, BoundsItsMemoryByTheOldestOfTheSensorThatComes) {
  const std::vector<stream::Sample> many(Understudy::kMostSamples - 2, sample(1));
  understudy_.follow("many", many, 0);
  for (std::uint64_t k = 1; k <= 4; ++k) follow("few", k, 0);
  follow("none", 1, 0);
  const auto parts = understudy_.take(all, 0);
  ASSERT_EQ(parts.size(), 2U);
  const auto& few = parts[0].sensor == "few" ? parts[0] : parts[1];
  ASSERT_EQ(few.samples.size(), 2U);
  EXPECT_EQ(few.samples[0].sequence, 3U);
  understudy_.follow("many", many, 0);
  EXPECT_EQ(understudy_.take(all, 0).at(0).samples.size(), many.size())
      << "what was given out has left its room";
}

// The daemon that served it had all of that, or its mark would be of that.
TEST_F(UnderstudyTest, KeepsNothingOfASensorFromBeforeItBeganAnew) {
  follow("imu", 900, 0);
  understudy_.end("imu");
  follow("imu", 901, 1);
  EXPECT_THAT(taken(2), ElementsAre(901)) << "it had ended";
  follow("imu", 900, 3);
  follow("imu", 1, 4);
  follow("imu", 2, 5);
  EXPECT_THAT(taken(6), ElementsAre(1, 2)) << "its numbers begin anew";
}

TEST_F(UnderstudyTest, SensorsThatHaveStoppedMakeRoom) {
  understudy_.follow("stopped", std::vector<stream::Sample>(Understudy::kMostSamples, sample(1)), 0);
  follow("new", 1, 2999);
  follow("new", 2, 3001);
  follow("new", 3, 4001);
  EXPECT_THAT(taken(4001), ElementsAre(3)) << "looked for once a second";
  for (std::size_t k = 0; k < Understudy::kMostSensors; ++k) follow(std::to_string(k), 1, 10'000);
  follow("one more", 1, 10'001);
  EXPECT_EQ(understudy_.take(all, 10'001 * kMs).size(), Understudy::kMostSensors);
}

TEST_F(UnderstudyTest, TellsTheMarkOfASensorOnceAndForAMinute) {
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {7, 70}}, {"other", {8, 80}}, {"third", {9, 90}}}, 0);
  EXPECT_TRUE(understudy_.has_marks());
  EXPECT_EQ(marked("imu", 1000), 7U);
  EXPECT_EQ(marked("imu", 1000), 0U);
  EXPECT_EQ(marked("other", 60'000), 8U);
  EXPECT_EQ(marked("third", 60'001), 0U);
  EXPECT_FALSE(understudy_.has_marks());
}

TEST_F(UnderstudyTest, OfTwoDaemonsThatServedOneAfterTheOtherTheLaterMarkHolds) {
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {20, 200}}}, 0);
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {10, 100}}}, kMs);
  EXPECT_EQ(marked("imu", 2), 20U) << "heard the other way round";
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {20, 200}}}, 0);
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {30, 300}}}, kMs);
  EXPECT_EQ(marked("imu", 2), 30U);
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {20, 200}}}, 0);
  understudy_.note(std::vector<bus::GivenUp>{{"imu", {5, 50}}}, 61'000 * kMs);
  EXPECT_EQ(marked("imu", 61'001), 5U) << "the other one is of the past";
}

}  // namespace
}  // namespace gyrod::app
