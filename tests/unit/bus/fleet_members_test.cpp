/// Daemons of one fleet that find one another by what their writers of denoised samples tell.
#include "bus/fleet_members.hpp"

#include <cstdio>
#include <optional>

#include <gmock/gmock.h>

#include "bus/entity.hpp"
#include "bus/fleet_hand_overs.hpp"
#include "bus/loan.hpp"
#include "bus/qos.hpp"
#include "bus/topic_writer.hpp"
#include "bus/writer_identity.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

using ::testing::ElementsAre;

/// Sensors of all shards of two.
std::vector<GivenUp> sensors() {
  return {{"imu_1", {101, 1'001}}, {"imu_2", {102, 1'002}}, {"imu_3", {103, 1'003}}, {"imu_4", {104, 1'004}}};
}

/// Those that the first rule serves, and the second does not.
std::vector<GivenUp> given_up(const fleet::ServingRule& first, const fleet::ServingRule& second) {
  std::vector<GivenUp> given = sensors();
  std::erase_if(given,
                [&](const GivenUp& one) { return !first.serves(one.sensor) || second.serves(one.sensor); });
  return given;
}

/// Serves sensors(), and keeps what it is told.
class Handler final : public FleetHandler {
 public:
  std::vector<GivenUp> on_rule(const fleet::ServingRule& rule, bool told) noexcept override {
    const std::lock_guard lock(mutex_);
    const fleet::ServingRule before = rules_.empty() ? fleet::ServingRule{rule.own} : rules_.back();
    rules_.push_back(rule);
    told_ = told;
    return given_up(before, rule);
  }
  std::vector<GivenUp> on_leave() noexcept override { return given_up(rule(), {rule().own}); }
  void on_given_up(std::span<const GivenUp> given) noexcept override {
    const std::lock_guard lock(mutex_);
    heard_.assign(given.begin(), given.end());
  }
  void on_standing(const fleet::Standing& /*standing*/) noexcept override {}

  [[nodiscard]] std::vector<fleet::ServingRule> rules() const {
    const std::lock_guard lock(mutex_);
    return rules_;
  }
  [[nodiscard]] fleet::ServingRule rule() const { return rules().back(); }
  /// With the last rule.
  [[nodiscard]] bool told() const {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  /// What others gave up last.
  [[nodiscard]] std::vector<GivenUp> heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<fleet::ServingRule> rules_;
  bool told_ = false;
  std::vector<GivenUp> heard_;
};

/// Too short for a network, and long enough for one process.
constexpr FleetTimes kShort{.listening_s = 0.2, .joining_s = 0.05, .longest_s = 60.0};

/// One daemon.
class Member {
 public:
  Member(const Domain& domain, BusOptions options, std::optional<fleet::Shard> shard,
         FleetTimes times = kShort)
      : options_(std::move(options)),
        publisher_(domain, with(shard)),
        members_(domain, publisher_, options_, handler_, times) {
    members_.start();
  }

  [[nodiscard]] fleet::Standing standing() const { return members_.standing(); }
  [[nodiscard]] const Handler& handler() const { return handler_; }
  [[nodiscard]] bool is_active() const { return standing().active; }
  void leave() { members_.leave(); }

 private:
  const BusOptions& with(std::optional<fleet::Shard> shard) {
    options_.shard = shard;
    return options_;
  }

  BusOptions options_;
  Publisher publisher_;
  Handler handler_;
  FleetMembers members_;
};

/// A writer of another program on the topic, with user data of its own.
class Stranger {
 public:
  Stranger(const Domain& domain, const BusOptions& options, const std::string& text)
      : domain_(domain),
        writer_(domain_.participant(), options.topics.denoised, output_writer_qos(options).user_data(text)) {}

  [[nodiscard]] std::string id() const { return guid_of(writer_.get()); }

  void tell(const std::string& text) const {
    Qos qos;
    qos.user_data(text);
    ASSERT_EQ(dds_set_qos(writer_.get(), qos.get()), DDS_RETCODE_OK);
  }

 private:
  Domain domain_;
  TopicWriter<gyrod_DenoisedSample> writer_;
};

class FleetMembersTest : public BusTest {
 protected:
  /// What the newest writer of the topic that shows a user data tells, as another program reads it; the id it has among all.
  struct Told {
    std::string id;
    std::string text;
  };
  [[nodiscard]] Told look() {
    const Loan<dds_builtintopic_endpoint_t> loan(publications_.get());
    for (std::size_t i = 0; i < loan.size(); ++i) {
      const dds_builtintopic_endpoint_t& writer = loan.message(i);
      if (!loan.info(i).valid_data || writer.topic_name != options_.topics.denoised) continue;
      void* data = nullptr;
      std::size_t size = 0;
      told_.text.clear();
      if (dds_qget_userdata(writer.qos, &data, &size)) told_.text = {static_cast<char*>(data), size};
      dds_free(data);
      told_.id.clear();
      for (const std::uint8_t byte : writer.key.v) {
        char hex[3];
        std::snprintf(hex, sizeof hex, "%02x", static_cast<unsigned>(byte));
        told_.id += hex;
      }
    }
    return told_;
  }

  const Domain here_ = reader_domain();
  const Domain there_ = writer_domain();

 private:
  Entity publications_{
      dds_create_reader(there_.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr), "look"};
  Told told_;
};

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
    EXPECT_EQ(small.standing().overlapping, 1U);
    EXPECT_EQ(large.standing().disputes + small.standing().disputes, 0U);
    large.leave();
    wait_until([&] { return small.standing().peers == 0; });
  }
  EXPECT_EQ(small.handler().rule(), (fleet::ServingRule{{1, 1}, true}));
}

TEST_P(FleetMembersTest, WhoServesWhatAnotherGaveUpHasBeenToldHowFarThatWas) {
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

TEST_P(FleetMembersTest, NothingIsTakenWhileAnAnnouncedHandOverHasNotCome) {
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
TEST_P(FleetMembersTest, WhoSaysByItsLastHandOverThatItLeavesIsGoneWhateverItAnnounced) {
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

TEST_P(FleetMembersTest, AnAnnouncedHandOverIsNotWaitedForForEver) {
  const Stranger silent(there_, options_, "gyrod.shard=1/1;gyrod.state=active;gyrod.handed=0;");
  const Member member(here_, options_, fleet::Shard{2, 2},
                      {.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2, .hand_over_s = 0.1});
  wait_until([&] { return member.is_active(); });
  silent.tell("gyrod.shard=1/1;gyrod.state=active;gyrod.handed=1;gyrod.yields=" + look().id + ";");
  wait_until([&] { return member.handler().rule().left.empty(); });
  EXPECT_FALSE(member.handler().told());
}

TEST_P(FleetMembersTest, OfOneThatVanishesOrTellsNoHandOversNobodyIsToldHowFarItWas) {
  const FleetTimes hasty{.listening_s = 0.2, .joining_s = 0.0, .longest_s = 0.2};
  for (const std::string handed : {"", "gyrod.handed=0;"}) {
    std::optional<Stranger> other(std::in_place, there_, options_,
                                  "gyrod.shard=1/1;gyrod.state=active;" + handed);
    const Member member(here_, options_, fleet::Shard{2, 2}, hasty);
    wait_until([&] { return member.is_active(); });
    EXPECT_EQ(member.handler().rule().left.size(), 1U);
    if (handed.empty()) {
      other->tell("gyrod.shard=1/1;gyrod.state=active;gyrod.yields=" + look().id + ";");
    } else {
      other.reset();
    }
    wait_until([&] { return member.handler().rule().left.empty(); });
    EXPECT_FALSE(member.handler().told()) << handed;
  }
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
