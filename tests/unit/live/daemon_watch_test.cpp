#include "live/daemon_watch.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace gyrod::live {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class DaemonWatchTest : public ::testing::Test {
 protected:
  std::vector<std::string> after(double seconds) {
    now_s_ += seconds;
    return watch_.look(now_s_, engine_, 64);
  }
  std::uint64_t& refused() {
    return engine_.totals.rejected[static_cast<std::size_t>(stream::RejectReason::kTooManyChannels)];
  }

  DaemonWatch watch_;
  stream::EngineSnapshot engine_;
  double now_s_ = 1000.0;
};

TEST_F(DaemonWatchTest, AllIsWellSaysNothing) {
  EXPECT_THAT(after(0.0), IsEmpty());
  EXPECT_THAT(after(100.0), IsEmpty());
}

TEST_F(DaemonWatchTest, OverloadIsToldAsItGrowsAndOnceItIsOver) {
  (void)after(0.0);
  engine_.overload_step = 1;
  EXPECT_THAT(after(1.0),
              ElementsAre("Overload step 1 of 2, before 0: windows come less often (hop widened)."));
  EXPECT_THAT(after(1.0), IsEmpty());
  engine_.overload_step = 2;
  EXPECT_THAT(after(1.0), ElementsAre("Overload step 2 of 2, before 1: samples pass through undenoised."));
  engine_.overload_step = 0;
  EXPECT_THAT(after(9.0), IsEmpty()) << "it may come back";
  EXPECT_THAT(after(1.0), ElementsAre("Overload is over, before step 2 of 2."));
  EXPECT_THAT(after(100.0), IsEmpty());
}

TEST_F(DaemonWatchTest, AnOverloadThatComesAndGoesIsOne) {
  engine_.overload_step = 1;
  EXPECT_THAT(after(0.0).size(), 1U);
  for (int i = 0; i < 5; ++i) {
    engine_.overload_step = 0;
    EXPECT_THAT(after(6.0), IsEmpty());
    engine_.overload_step = 1;
    EXPECT_THAT(after(1.0), IsEmpty());
  }
}

TEST_F(DaemonWatchTest, AnOverloadBetweenTwoLooksIsInTheCounts) {
  engine_.totals.hops_widened = 3;
  engine_.totals.overloads = 1;
  EXPECT_THAT(after(1.0), ElementsAre("Overload step 2 of 2, before 0: samples pass through undenoised."));
  EXPECT_THAT(after(10.0), ElementsAre("Overload is over, before step 2 of 2."));
  engine_.totals.hops_widened = 4;
  EXPECT_THAT(after(1.0),
              ElementsAre("Overload step 1 of 2, before 0: windows come less often (hop widened)."));
}

TEST_F(DaemonWatchTest, AFloodOfIdsIsToldOnceAMinuteInSum) {
  refused() = 5;
  EXPECT_THAT(after(0.0), ElementsAre("5 samples refused, of sensors beyond limits.max_channels (64)."));
  refused() = 100;
  EXPECT_THAT(after(59.0), IsEmpty());
  refused() = 105;
  EXPECT_THAT(after(1.0), ElementsAre("100 samples refused, of sensors beyond limits.max_channels (64)."));
  EXPECT_THAT(after(600.0), IsEmpty());
}

}  // namespace
}  // namespace gyrod::live
