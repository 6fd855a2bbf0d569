/// Daemons of one fleet that find one another by what their writers of denoised samples tell.
#include "bus/fleet_members.hpp"

#include <cstdio>
#include <optional>

#include <gmock/gmock.h>

#include "bus/entity.hpp"
#include "bus/loan.hpp"
#include "bus/qos.hpp"
#include "bus/topic_writer.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

using ::testing::ElementsAre;

/// Keeps what it is told.
class Handler final : public FleetHandler {
 public:
  void on_rule(const fleet::ServingRule& rule) noexcept override {
    const std::lock_guard lock(mutex_);
    rules_.push_back(rule);
  }
  void on_standing(const fleet::Standing& /*standing*/) noexcept override {}

  [[nodiscard]] std::vector<fleet::ServingRule> rules() const {
    const std::lock_guard lock(mutex_);
    return rules_;
  }
  [[nodiscard]] fleet::ServingRule rule() const { return rules().back(); }

 private:
  mutable std::mutex mutex_;
  std::vector<fleet::ServingRule> rules_;
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
    return look().text == "gyrod.shard=1/1;gyrod.state=active;gyrod.yields=;gyrod.greets=;gyrod.awaits=;";
  });
}

TEST_P(FleetMembersTest, WithAShardItServesWhenItHasListenedAndJoinedAndTellsWhenItLeaves) {
  Member member(here_, options_, fleet::Shard{2, 3});
  EXPECT_THAT(member.handler().rules(), ElementsAre(fleet::ServingRule{{2, 3}, false}));
  wait_until([&] { return member.is_active(); });
  EXPECT_EQ(member.handler().rule(), (fleet::ServingRule{{2, 3}, true}));
  wait_until([&] {
    return look().text == "gyrod.shard=2/3;gyrod.state=active;gyrod.yields=;gyrod.greets=;gyrod.awaits=;";
  });
  member.leave();
  wait_until([&] { return look().text.empty(); });
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
