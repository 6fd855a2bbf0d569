#include "fleet/roster.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sensor_ids.hpp"

namespace gyrod::fleet {
namespace {

using State = Roster::State;

Announcement active(const Shard& shard, std::vector<std::string> yields = {}) {
  return {shard, true, std::move(yields)};
}

TEST(Roster, ATwinIsSeenAndHoldsNobodyUp) {
  Roster roster("a", {1, 2}, State::kActive);
  roster.show("b", active({1, 2}));
  EXPECT_EQ(roster.standing().twins, 1U);
  EXPECT_EQ(roster.rule(), (ServingRule{{1, 2}, true}));
}

TEST(Roster, AMissingShardIsSeen) {
  Roster roster("a", {1, 3}, State::kActive);
  EXPECT_EQ(roster.standing().missing, 2U);
  roster.show("b", active({3, 3}));
  EXPECT_EQ(roster.standing().missing, 1U);
  roster.show("c", active({2, 2}));  // all that is in 2 of 3 was in 2 of 2
  EXPECT_EQ(roster.standing().missing, 0U);
  roster.forget("c");
  EXPECT_EQ(roster.standing().missing, 1U);
}

TEST(Roster, TheLargerCountServesOnlyWhenTheSmallerHasYielded) {
  Roster large("b", {2, 2}, State::kActive);
  const auto mine = std::ranges::find_if(sensors(), [](const auto& s) { return holds({2, 2}, s); });
  large.show("a", active({1, 1}));
  EXPECT_FALSE(large.rule().serves(*mine));
  large.show("a", active({1, 1}, {"c"}));
  EXPECT_FALSE(large.rule().serves(*mine));
  large.show("a", active({1, 1}, {"b", "c"}));
  EXPECT_TRUE(large.rule().serves(*mine));
}

TEST(Roster, TheSmallerCountServesUntilTheLargerIsActive) {
  Roster small("a", {1, 1}, State::kActive);
  small.show("b", {{2, 2}, false, {}});
  EXPECT_EQ(small.rule(), (ServingRule{{1, 1}, true}));
  EXPECT_TRUE(small.announcement().yields_to.empty());
  small.show("b", active({2, 2}));
  EXPECT_EQ(small.rule(), (ServingRule{{1, 1}, true, {{2, 2}}}));
  EXPECT_EQ(small.announcement().yields_to, std::vector<std::string>{"b"});
}

TEST(Roster, WhoJoinsIsGreetedByThoseThatHaveHeardOfItAndWaitsForAllOfThem) {
  Roster joining("b", {2, 2}, State::kJoining);
  EXPECT_TRUE(joining.greeted()) << "nobody else is there";
  joining.show("a", active({1, 1}));
  joining.show("c", {{2, 3}, false, {}, {"b"}});
  EXPECT_FALSE(joining.greeted());
  EXPECT_EQ(joining.announcement().greets, std::vector<std::string>{"c"});

  Roster serving("a", {1, 1}, State::kActive);
  serving.show("b", joining.announcement());
  joining.show("a", serving.announcement());
  EXPECT_TRUE(joining.greeted());
  joining.advance_to(State::kActive);
  serving.show("b", joining.announcement());
  EXPECT_TRUE(serving.announcement().greets.empty()) << "it has joined";
}

TEST(Roster, TwoThatLostSightOfOneAnotherAreADisputeWhenTheyMeet) {
  Roster large("b", {2, 2}, State::kActive);
  large.show("a", active({1, 1}, {"b"}));
  large.forget("a");
  EXPECT_EQ(large.standing().disputes, 0U);
  large.show("a", active({1, 1}));
  EXPECT_EQ(large.standing().disputes, 1U);
  large.show("a", active({1, 1}, {"b"}));
  EXPECT_EQ(large.standing().disputes, 1U) << "counted once";
}

TEST(Roster, ALargerOneThatDoesNotKnowOfTheSmallerIsADispute) {
  const auto disputes_when_shown = [](const Announcement& larger) {
    Roster small("a", {1, 1}, State::kActive);
    small.show("b", larger);
    small.show("b", larger);
    return small.standing().disputes;
  };
  Announcement larger = active({2, 2});
  EXPECT_EQ(disputes_when_shown(larger), 1U) << "it took the shard for its own, and counted once";
  larger.awaits = {"c", "a"};
  EXPECT_EQ(disputes_when_shown(larger), 0U) << "it leaves it until this one yields";
  larger.awaits = {};
  larger.active = false;
  EXPECT_EQ(disputes_when_shown(larger), 0U) << "it serves nothing yet";
}

TEST(Roster, WhoeverWaitsForAnotherSaysSo) {
  Roster large("b", {2, 2}, State::kActive);
  large.show("a", active({1, 1}));
  EXPECT_EQ(large.announcement().awaits, std::vector<std::string>{"a"});
  large.show("a", active({1, 1}, {"b"}));
  EXPECT_TRUE(large.announcement().awaits.empty());
}

TEST(Roster, TakesNoticeOfSoManyAndNoMore) {
  Roster roster("self", {1, 1}, State::kActive);
  for (std::size_t k = 0; k < 2 * kMostPeers; ++k) roster.show(std::to_string(k), active({2, 2}));
  EXPECT_EQ(roster.standing().peers, kMostPeers);
}

}  // namespace
}  // namespace gyrod::fleet
