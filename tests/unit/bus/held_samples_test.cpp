#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "held_samples_fixture.hpp"

namespace gyrod::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST_F(HeldSamplesTest, ADaemonAlonePublishesAtOnce) {
  release(1, 3, 0.0);
  EXPECT_THAT(take(0.0, kAlone), ElementsAre(1, 2, 3));
  EXPECT_EQ(held_.takeovers(), 0U);
}

TEST_F(HeldSamplesTest, ADaemonThatHasNotLookedForOthersYetHolds) {
  Others unknown = kAlone;
  unknown.looked = false;
  release(1, 3, 0.0);
  EXPECT_THAT(take(5.0, unknown), IsEmpty());
  EXPECT_THAT(take(5.0, kAlone), ElementsAre(1, 2, 3));
}

TEST_F(HeldSamplesTest, TheStrongestPublishesASensorAtOnceFromItsFirstSampleOn) {
  release(0, 2, 0.0);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(0, 1, 2));
}

TEST_F(HeldSamplesTest, ASensorOfWhichNothingWasHeardIsLeftToTheOthersForAWhile) {
  release(7, 9, 0.0);
  EXPECT_THAT(take(60.0, kStrongest), IsEmpty())
      << "the sensor stands still, and 6 may be in the other's window";
  release(10, 12, 60.0);
  EXPECT_THAT(take(61.9, kStrongest), IsEmpty());
  EXPECT_THAT(take(62.0, kStrongest), ElementsAre(7, 8, 9, 10, 11, 12));
}

TEST_F(HeldSamplesTest, WhatIsMissingBeforeTheFirstSampleIsLeftToTheOthersForAWhile) {
  hear(5, false);
  release(8, 9, 0.0);
  EXPECT_THAT(take(60.0, kStrongest), IsEmpty()) << "6 and 7 are in the other's window";
  release(10, 11, 60.0);
  hear(9, false);
  EXPECT_THAT(take(60.0, kStrongest), ElementsAre(10, 11)) << "continues what was heard";
}

TEST_F(HeldSamplesTest, NoLongerWhereTheOthersHaveItNeither) {
  hear(5, false);
  release(8, 9, 0.0);
  release(10, 11, 1.0);
  EXPECT_THAT(take(2.9, kStrongest), IsEmpty());
  EXPECT_THAT(take(3.0, kStrongest), ElementsAre(8, 9, 10, 11));
}

TEST_F(HeldSamplesTest, NorWhereNoMoreWillCome) {
  hear(5, false);
  release(8, 9, 0.0);
  held_.complete();
  EXPECT_THAT(take(1.9, kStrongest), IsEmpty());
  EXPECT_THAT(take(2.0, kStrongest), ElementsAre(8, 9));
}

TEST_F(HeldSamplesTest, TheStrongestContinuesAlsoWhereTheSensorHasSkippedANumber) {
  release(1, 5, 0.0);
  release(8, 9, 0.0);  // 6 and 7 never came
  hear(5, false);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(8, 9));
}

TEST_F(HeldSamplesTest, TheWeakerLetsGoWhatItHearsAndHoldsTheRest) {
  release(1, 5, 0.0);
  hear(3, true);
  EXPECT_THAT(take(0.9, kWeaker), IsEmpty());
  EXPECT_EQ(held_.size(), 2U);
  EXPECT_EQ(held_.let_go(), 3U);
}

TEST_F(HeldSamplesTest, TheWeakerGoesOnWithTheFirstSampleThatIsMissingAndThenWaitsNoMore) {
  release(1, 5, 0.0);
  hear(3, true);
  EXPECT_THAT(take(1.0, kWeaker), ElementsAre(4, 5));
  EXPECT_EQ(held_.takeovers(), 1U);
  release(6, 6, 1.0);
  EXPECT_THAT(take(1.0, kWeaker), ElementsAre(6));
}

TEST_F(HeldSamplesTest, TheWeakerWaitsAlsoWhereTheOtherHasLeftUntilReadersKnowIt) {
  release(1, 5, 0.0);
  hear(3, true);
  EXPECT_THAT(take(0.9, kAlone), IsEmpty());
  EXPECT_THAT(take(1.0, kAlone), ElementsAre(4, 5));
}

TEST_F(HeldSamplesTest, TheWeakerWaitsUntilReadersHaveNoticedThatTheStrongerIsDead) {
  hear(3, true);
  release(4, 35, 0.0);  // a hop: the other would have sent it a while later, and is killed before
  EXPECT_THAT(take(1.2, stronger_that_lived(0.9)), IsEmpty()) << "readers would drop it";
  held_.hear_end(1.2);
  EXPECT_THAT(take(1.3, stronger_that_lived(0.9)), IsEmpty());
  EXPECT_EQ(take(1.5, stronger_that_lived(0.9)).size(), 32U);
}

TEST_F(HeldSamplesTest, WhatAStrongerOneOwnsAndDoesNotSendIsHeldAsLongAsItLives) {
  hear(3, true);
  release(4, 5, 0.0);
  EXPECT_THAT(take(60.0, stronger_that_lived(60.0)), IsEmpty()) << "readers would drop it";
}

TEST_F(HeldSamplesTest, ASensorThatAStrongerOneDoesNotHaveIsPublishedAfterTwiceTheTime) {
  release(4, 5, 0.0);
  EXPECT_THAT(take(1.9, stronger_that_lived(1.9)), IsEmpty());
  EXPECT_THAT(take(2.0, stronger_that_lived(2.0)), ElementsAre(4, 5));
}

TEST_F(HeldSamplesTest, ASensorThatHasEndedAtTheStrongerOneIsPublishedAfterTwiceTheTime) {
  hear(3, true);
  held_.hear_end(0.0);
  release(4, 5, 0.0);
  EXPECT_THAT(take(1.9, stronger_that_lived(1.9)), IsEmpty());
  EXPECT_THAT(take(2.0, stronger_that_lived(2.0)), ElementsAre(4, 5));
}

TEST_F(HeldSamplesTest, TheStrongestComesBackWhereTheOtherIsAndTheOtherStops) {
  Others unknown = kStrongest;
  unknown.looked = false;
  release(7, 9, 0.0);
  hear(5, false);
  EXPECT_THAT(take(0.0, kStrongest), IsEmpty()) << "6 is still to come from the other";
  hear(7, false);
  EXPECT_THAT(take(0.0, unknown), IsEmpty()) << "more may have been published than was heard yet";
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(8, 9)) << "continues what was heard";

  HeldSamples<stream::DenoisedSample> other{{.takeover_s = 1.0, .most = 100}};
  const auto ignore = [](const auto&) {};
  const stream::DenoisedSample eight = sample(8);
  other.release({&eight, 1}, 0.0);
  other.take(1.0, kWeaker, ignore);
  ASSERT_TRUE(other.active());
  other.hear({9, 90}, true);
  EXPECT_FALSE(other.active());
}

TEST_F(HeldSamplesTest, TheStrongestDoesNotMindTheWeaker) {
  release(0, 1, 0.0);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(0, 1));
  hear(3, false);
  release(2, 4, 0.1);
  EXPECT_THAT(take(0.1, kStrongest), ElementsAre(2, 3, 4)) << "readers have dropped what the weaker one sent";
}

TEST_F(HeldSamplesTest, NorDoesItBelieveTheWeakerAfterAPause) {
  release(0, 1, 0.0);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(0, 1));
  hear(3, false);  // dropped by the readers
  held_.doubt();
  release(2, 4, 0.1);
  EXPECT_THAT(take(0.1, kStrongest), ElementsAre(2, 3, 4)) << "continues what it has published itself";
}

TEST_F(HeldSamplesTest, WhoWasStoppedPublishesNothingTwice) {
  release(0, 1, 0.0);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(0, 1));
  held_.doubt();
  release(2, 9, 5.0);
  hear(6, false);  // meanwhile the other has taken over
  EXPECT_THAT(take(5.0, kStrongest), ElementsAre(7, 8, 9));
}

TEST_F(HeldSamplesTest, NoMoreIsHeldThanThereIsRoomForAndNothingIsLost) {
  release(1, 100, 0.0);
  EXPECT_EQ(take(0.0, kWeaker).size(), 100U);
}

TEST_F(HeldSamplesTest, WhatTheOtherHasPublishedStaysKnownWhenItIsGone) {
  hear(3, true);
  held_.hear_end(0.0);
  release(1, 5, 60.0);  // the sensor stood still meanwhile
  EXPECT_THAT(take(61.0, kAlone), ElementsAre(4, 5));
}

TEST_F(HeldSamplesTest, ASensorThatBeginsAnewIsNotTakenForWhatWasPublished) {
  hear(1000, true);
  const stream::DenoisedSample anew{.sequence = 0, .stamp_ns = 20'000};
  held_.release({&anew, 1}, 0.0);
  EXPECT_THAT(take(0.5, kWeaker), IsEmpty());
  EXPECT_EQ(held_.let_go(), 0U);
}

TEST_F(HeldSamplesTest, WhatWasHeardIsNotPublishedAgainWhenTheOtherEndsTheSensorAtOnce) {
  release(1, 3, 0.0);
  hear(3, true);
  held_.hear_end(0.0);
  EXPECT_THAT(take(1.0, kWeaker), IsEmpty());
}

}  // namespace
}  // namespace gyrod::bus
