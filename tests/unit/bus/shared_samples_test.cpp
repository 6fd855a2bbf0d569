#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "held_samples_fixture.hpp"

namespace gyrod::bus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Readers take all that comes, and the sensor does not count: a ROS 2 topic.
class SharedSamplesTest : public HeldSamplesTest {
 protected:
  SharedSamplesTest() {
    held_ = HeldSamples<stream::DenoisedSample>({.takeover_s = 1.0, .most = 100, .exclusive = false});
  }
  void release(std::int64_t first, std::int64_t last, double now_s) {
    for (std::int64_t stamp = first; stamp <= last; ++stamp) {
      const stream::DenoisedSample one{.sequence = 0, .stamp_ns = stamp};
      held_.release({&one, 1}, now_s);
    }
  }
  void hear(std::int64_t stamp, bool stronger) { held_.hear({0, stamp}, stronger); }
  std::vector<std::int64_t> take(double now_s, const Others& others) {
    std::vector<std::int64_t> taken;
    held_.take(now_s, others, [&taken](const auto& one) { taken.push_back(one.stamp_ns); });
    return taken;
  }
};

TEST_F(SharedSamplesTest, StampsTellWhatHasBeenPublished) {
  release(1, 5, 0.0);
  hear(3, true);
  EXPECT_EQ(held_.let_go(), 3U);
  EXPECT_THAT(take(0.9, kWeaker), IsEmpty());
  EXPECT_THAT(take(1.0, kWeaker), ElementsAre(4, 5));
}

TEST_F(SharedSamplesTest, TheStrongestBeginsAndTakesNothingBack) {
  release(1, 1, 0.0);
  EXPECT_THAT(take(0.0, kStrongest), ElementsAre(1));
  held_.doubt();
  release(2, 4, 5.0);
  hear(3, false);
  EXPECT_THAT(take(5.9, kStrongest), IsEmpty()) << "the other one goes on";
  hear(4, false);
  EXPECT_THAT(take(6.5, kStrongest), IsEmpty());
}

TEST_F(SharedSamplesTest, WhereTheOtherHasLeftTheNextGoesOnAtOnce) {
  release(1, 5, 0.0);
  hear(3, true);
  EXPECT_THAT(take(0.1, kAlone), ElementsAre(4, 5));
}

TEST_F(SharedSamplesTest, TheTailOfOneThatHasLeftIsNotPublishedAgain) {
  hear(5, true);
  held_.hear_end(0.0);
  release(3, 7, 0.2);  // its last look-ahead comes only now
  EXPECT_THAT(take(0.2, kAlone), ElementsAre(6, 7));
}

TEST_F(SharedSamplesTest, ASensorWhoseStampsGoBackAfterTheOtherHasLeftIsPublished) {
  hear(5, true);
  held_.hear_end(0.0);
  release(1, 2, 1.1);
  EXPECT_THAT(take(1.1, kAlone), ElementsAre(1, 2));
}

TEST_F(SharedSamplesTest, WhoHasJustStartedGivesTheOthersItsTimeBeforeItTakesOver) {
  Others unknown = kWeaker;
  unknown.looked = false;
  release(1, 3, 0.0);
  EXPECT_THAT(take(1.5, unknown), IsEmpty());
  EXPECT_THAT(take(2.4, kWeaker), IsEmpty()) << "the strongest begins when it has looked, and is heard";
  EXPECT_THAT(take(2.5, kWeaker), ElementsAre(1, 2, 3));
}

TEST_F(SharedSamplesTest, OfTwoThatPublishTheWeakerStops) {
  release(1, 1, 0.0);
  EXPECT_THAT(take(1.0, kWeaker), ElementsAre(1));
  hear(1, true);
  EXPECT_FALSE(held_.active());
}

}  // namespace
}  // namespace gyrod::bus
