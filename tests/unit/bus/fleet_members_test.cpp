/// Daemons of one fleet that find one another by what their writers of denoised samples tell.
#include <gmock/gmock.h>

#include "unit/bus/fleet_members_fixture.hpp"

namespace gyrod::bus::test {
namespace {

using ::testing::ElementsAre;

TEST_P(FleetMembersTest, WithoutAShardItServesAllAtOnceAndSaysSo) {
  const Member member(here_, options_, std::nullopt);
  EXPECT_EQ(member.handler().rule(), (fleet::ServingRule{{1, 1}, true})) << "with its start";
  wait_until([&] {
    return look().text ==
           "gyrod.shard=1/1;gyrod.state=active;gyrod.yields=;gyrod.greets=;gyrod.awaits=;gyrod.handed=0;";
  });
}

TEST_P(FleetMembersTest, WithAShardItServesWhenItHasListenedAndJoinedAndTellsWhenItLeaves) {
  Member member(here_, options_, fleet::Shard{2, 3});
  EXPECT_THAT(member.handler().rules(), ElementsAre(fleet::ServingRule{{2, 3}, false}));
  wait_until([&] { return member.is_active(); });
  EXPECT_EQ(member.handler().rule(), (fleet::ServingRule{{2, 3}, true}));
  wait_until([&] {
    return look().text ==
           "gyrod.shard=2/3;gyrod.state=active;gyrod.yields=;gyrod.greets=;gyrod.awaits=;gyrod.handed=0;";
  });
  member.leave();
  wait_until([&] { return look().text == "gyrod.handed=1;"; });
}

TEST_P(FleetMembersTest,
       OfTwoThatHoldASensorTheLargerCountServesWhenTheOtherHasYieldedAndIsGivenBackWhenItLeaves) {
  const Member small(there_, options_, fleet::Shard{1, 1});
  wait_until([&] { return small.is_active(); });
  {
    Member large(here_, options_, fleet::Shard{2, 2});
    wait_until([&] { return large.is_active() && large.handler().rule().left.empty(); });
    EXPECT_EQ(small.handler().rule(), (fleet::ServingRule{{1, 1}, true, {{2, 2}}}));
    EXPECT_EQ(large.standing().peers, 1U);
    wait_until([&] { return small.standing().overlapping == 1; });  // shown after its rule
    EXPECT_EQ(large.standing().disputes + small.standing().disputes, 0U);
    large.leave();
    wait_until([&] { return small.standing().peers == 0; });
  }
  EXPECT_EQ(small.handler().rule(), (fleet::ServingRule{{1, 1}, true}));
}

// Writers of a program are heard of in the order in which it made them.
TEST_P(FleetMembersTest, WhoWritesToAnotherTopicOrPartitionOrTellsNothingOfGyrodIsNoPeer) {
  const Member member(here_, options_, std::nullopt);
  BusOptions other_topic = options_;
  other_topic.topics.denoised += "_other";
  BusOptions other_partition = options_;
  other_partition.output.partitions = {"elsewhere"};
  const std::string active = "gyrod.shard=2/2;gyrod.state=active;";
  const Stranger elsewhere(there_, other_partition, active);
  const Stranger besides(there_, other_topic, active);
  const Stranger silent(there_, options_, "");
  const Stranger mad(there_, options_, "gyrod.shard=3/2;gyrod.state=active;");
  const std::string bytes("gyrod.shard=2/2;gyrod.state=\xff\x00\x1b[2J;", 34);
  const Stranger binary(there_, options_, bytes);
  const Stranger peer(there_, options_, active);
  wait_until([&] { return member.standing().peers > 0; });
  EXPECT_EQ(member.standing().peers, 1U);
  peer.tell("gyrod.shard=nonsense;");
  wait_until([&] { return member.standing().peers == 0; });
}

TEST_P(FleetMembersTest, ItJoinsUntilAllThatItKnowsHaveHeardOfIt) {
  const std::string active = "gyrod.shard=1/1;gyrod.state=active;";
  const Stranger slow(there_, options_, active);
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 0.2, .joining_s = 0.0, .longest_s = 60.0});
  wait_until([&] { return look().text.find("gyrod.state=joining") != std::string::npos; });
  const std::string id = look().id;
  slow.tell("gyrod.shard=1/1;gyrod.state=joining;");
  wait_until([&] { return member.standing().peers == 0; });
  slow.tell(active + "gyrod.greets=somebody_else;");
  wait_until([&] { return member.standing().peers == 1; });
  EXPECT_FALSE(member.is_active());
  slow.tell(active + "gyrod.greets=" + id + ";");
  wait_until([&] { return member.is_active(); });
  EXPECT_THAT(member.handler().rule().left, ElementsAre(fleet::Shard{1, 1})) << "that has not yielded yet";
  slow.tell(active + "gyrod.yields=" + id + ";");
  wait_until([&] { return member.handler().rule().left.empty(); });
}

TEST_P(FleetMembersTest, ItWaitsNoLongerThanItsLongestForOneThatDoesNotGreet) {
  const Stranger deaf(there_, options_, "gyrod.shard=1/1;gyrod.state=active;");
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 60.0, .joining_s = 0.0, .longest_s = 0.2});
  wait_until([&] { return member.is_active(); });
}

INSTANTIATE_TEST_SUITE_P(Bus, FleetMembersTest, ::testing::Values(Route::kInProcess, Route::kUdp),
                         route_name);

}  // namespace
}  // namespace gyrod::bus::test
