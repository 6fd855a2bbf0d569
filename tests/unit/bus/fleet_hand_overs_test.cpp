/// What daemons of one fleet tell one another when sensors change hands.
#include <gmock/gmock.h>

#include "unit/bus/fleet_members_fixture.hpp"

namespace gyrod::bus::test {
namespace {

class FleetHandOversTest : public FleetMembersTest {};

TEST_P(FleetHandOversTest, WhoServesWhatAnotherGaveUpHasBeenToldHowFarThatWas) {
  const Member small(there_, options_, fleet::Shard{1, 1});
  wait_until([&] { return small.is_active(); });
  const fleet::ServingRule all = small.handler().rule();
  Member large(here_, options_, fleet::Shard{2, 2});
  wait_until([&] { return large.is_active() && large.handler().rule().left.empty(); });
  const std::vector<GivenUp> handed = given_up(all, small.handler().rule());
  ASSERT_FALSE(handed.empty());
  ASSERT_LT(handed.size(), sensors().size());
  EXPECT_EQ(large.handler().heard(), handed);
  EXPECT_TRUE(large.handler().told());
  large.leave();
  wait_until([&] { return small.handler().rule().left.empty(); });
  EXPECT_EQ(small.handler().heard(), handed);
  EXPECT_TRUE(small.handler().told());
}

TEST_P(FleetHandOversTest, NothingIsTakenWhileAnAnnouncedHandOverHasNotCome) {
  const Stranger silent(there_, options_, "gyrod.shard=1/1;gyrod.state=active;gyrod.handed=0;");
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2, .hand_over_s = 3600.0});
  wait_until([&] { return member.is_active(); });
  wait_until([&] { return look().text.find("gyrod.awaits=;") == std::string::npos; });
  silent.tell("gyrod.shard=1/1;gyrod.state=active;gyrod.handed=1;gyrod.yields=" + look().id + ";");
  wait_until([&] { return look().text.find("gyrod.awaits=;") != std::string::npos; });
  EXPECT_EQ(member.handler().rule().left, (std::vector{fleet::Shard{1, 1}}));
  // A daemon with that id tells.
  FleetHandOvers other(there_, options_, silent.id(), DDS_INFINITY);
  ASSERT_TRUE(other.tell({}, false));
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_TRUE(member.handler().told());
}

// Discovery's news may be lost on their way when the process ends.
TEST_P(FleetHandOversTest, WhoSaysByItsLastHandOverThatItLeavesIsGoneWhateverItAnnounced) {
  const std::string active = "gyrod.shard=1/1;gyrod.state=active;gyrod.handed=0;";
  const Stranger other(there_, options_, active);
  FleetHandOvers hand_overs(there_, options_, other.id(), DDS_INFINITY);
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2});
  wait_until([&] { return member.is_active(); });
  EXPECT_EQ(member.handler().rule().left, (std::vector{fleet::Shard{1, 1}}));
  ASSERT_TRUE(hand_overs.tell(sensors(), true));
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_TRUE(member.handler().told());
  EXPECT_EQ(member.handler().heard(), sensors());
  other.tell(active + "late=1;");
  const Stranger newcomer(there_, options_, "gyrod.shard=3/3;gyrod.state=active;");
  wait_until([&] { return !member.handler().rule().left.empty(); });
  EXPECT_EQ(member.handler().rule().left, (std::vector{fleet::Shard{3, 3}}))
      << "the newcomer, not what is late of the other";
}

TEST_P(FleetHandOversTest, AnAnnouncedHandOverIsNotWaitedForForEver) {
  const Stranger silent(there_, options_, "gyrod.shard=1/1;gyrod.state=active;gyrod.handed=0;");
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2, .hand_over_s = 0.1});
  wait_until([&] { return member.is_active(); });
  silent.tell("gyrod.shard=1/1;gyrod.state=active;gyrod.handed=1;gyrod.yields=" + look().id + ";");
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_FALSE(member.handler().told());
}

constexpr FleetTimes kHasty{.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2};

TEST_P(FleetHandOversTest, OfOneThatTellsNoHandOversNobodyIsToldHowFarItWas) {
  const Stranger other(there_, options_, "gyrod.shard=1/1;gyrod.state=active;");
  const Member member(here_, options_, fleet::Shard{2, 2}, kHasty);
  wait_until([&] { return member.is_active(); });
  EXPECT_EQ(member.handler().rule().left.size(), 1U);
  other.tell("gyrod.shard=1/1;gyrod.state=active;gyrod.yields=" + look().id + ";");
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_FALSE(member.handler().told());
}

TEST_P(FleetHandOversTest, OfOneThatVanishesNobodyIsToldHowFarItWas) {
  std::optional<Stranger> other(std::in_place, there_, options_,
                                "gyrod.shard=1/1;gyrod.state=active;gyrod.handed=0;");
  const Member member(here_, options_, fleet::Shard{2, 2}, kHasty);
  wait_until([&] { return member.is_active(); });
  EXPECT_EQ(member.handler().rule().left.size(), 1U);
  other.reset();
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_FALSE(member.handler().told());
}

INSTANTIATE_TEST_SUITE_P(Bus, FleetHandOversTest, ::testing::Values(Route::kInProcess, Route::kUdp),
                         route_name);

}  // namespace
}  // namespace gyrod::bus::test
