/// Deadlines, liveliness and partitions of the raw topics.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bus/bus_error.hpp"
#include "bus/raw_writer.hpp"
#include "bus/subscriber.hpp"
#include "unit/bus/subscriber_fixture.hpp"

namespace gyrod::bus::test {
namespace {

using stream::ChannelState;
using testing::ElementsAre;
using testing::Pair;

class PromisesTest : public SubscriberTest {};

TEST_P(PromisesTest, AMissedDeadlineIsToldWithItsSensorAndCounted) {
  options_.input.deadline_s = 0.2;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "gyro", make_samples(0, 10));
  ASSERT_TRUE(collector_.wait_for_broken_promises(1));
  EXPECT_EQ(collector_.broken_promises().front(),
            std::pair(std::string("gyro"), ChannelState::kDeadlineMissed));
  EXPECT_GE(subscriber.broken_promises().deadlines_missed, 1U);
  EXPECT_EQ(subscriber.broken_promises().liveliness_lost, 0U);
  EXPECT_TRUE(collector_.ends().empty()) << "it has a writer";
  EXPECT_EQ(collector_.samples("gyro").size(), 10U);
}

TEST_P(PromisesTest, ASensorThatEndedMissesNoDeadline) {
  options_.input.deadline_s = 0.05;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "ended", make_samples(0, 10));
  ASSERT_TRUE(writer.end("ended"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  const std::size_t before =
      collector_.broken_promises().size();  // a slow machine may miss one before the end
  publish_all(writer, "other", make_samples(0, 10));
  ASSERT_TRUE(collector_.wait_for_broken_promises(before + 2)) << "the other one's deadline passes twice";
  const auto broken = collector_.broken_promises();
  for (std::size_t i = before; i < broken.size(); ++i) EXPECT_EQ(broken[i].first, "other");
}

TEST_P(PromisesTest, AWriterThatGivesNoSignOfLifeEndsItsSensorsAndTheReasonIsTold) {
  options_.input.liveliness = Liveliness::kManualByTopic;
  options_.input.lease_s = 0.3;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "a", make_samples(0, 10));
  publish_all(writer, "b", make_samples(0, 10));
  ASSERT_TRUE(collector_.wait_for_broken_promises(2));
  EXPECT_THAT(collector_.ends(), testing::UnorderedElementsAre(Pair("a", 10), Pair("b", 10)));
  EXPECT_THAT(collector_.broken_promises(),
              testing::UnorderedElementsAre(Pair("a", ChannelState::kLivelinessLost),
                                            Pair("b", ChannelState::kLivelinessLost)));
  EXPECT_EQ(subscriber.broken_promises().liveliness_lost, 1U) << "one writer";
  publish_all(writer, "a", make_samples(10, 10));  // a sign of life
  ASSERT_TRUE(collector_.wait_for_broken_promises(3));
  EXPECT_EQ(collector_.samples("a").size(), 20U);
  EXPECT_EQ(subscriber.broken_promises().liveliness_lost, 2U);
}

TEST_P(PromisesTest, ASensorThatIsUnregisteredBreaksNoPromise) {
  options_.input.lease_s = 10.0;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "gyro", make_samples(0, 10));
  ASSERT_TRUE(writer.end("gyro"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_TRUE(collector_.broken_promises().empty());
}

TEST_P(PromisesTest, PartitionsKeepVehiclesApart) {
  BusOptions other = options_;
  options_.input.partitions = {"car7"};
  other.input.partitions = {"car8"};
  BusOptions every = options_;
  every.input.partitions = {"car*"};
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  SampleCollector all;
  Subscriber everywhere(reader_domain(), every, all);
  everywhere.start();
  RawWriter seven = matched_writer(1);
  RawWriter eight = matched_writer(other, 1);
  wait_until([&] { return everywhere.matched_writers() == 2U && subscriber.matched_writers() == 1U; });
  publish_all(eight, "gyro8", make_samples(0, 10));
  publish_all(seven, "gyro7", make_samples(0, 10));
  ASSERT_TRUE(all.wait_for_samples(20));
  ASSERT_TRUE(collector_.wait_for_samples(10));
  EXPECT_EQ(collector_.samples("gyro7").size(), 10U);
  EXPECT_TRUE(collector_.samples("gyro8").empty());
}

TEST_P(PromisesTest, ASingleTopicHasWhatIsSaidOfIt) {
  options_.topic_qos = {{.topic = options_.topics.raw_batch, .partitions = std::vector<std::string>{"fast"}}};
  BusOptions elsewhere = options_;
  elsewhere.topic_qos.clear();
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter single = matched_writer(1);
  RawWriter batch = matched_writer(10);
  RawWriter lost(writer_domain(), elsewhere, 10);
  settle(writer_domain(), reader_domain());
  wait_until([&] { return subscriber.matched_writers() == 2U; });
  publish_all(lost, "lost", make_samples(0, 10));
  publish_all(batch, "batch", make_samples(0, 10));
  publish_all(single, "single", make_samples(0, 10));
  ASSERT_TRUE(collector_.wait_for_samples(20));
  EXPECT_TRUE(collector_.samples("lost").empty());
}

INSTANTIATE_TEST_SUITE_P(Bus, PromisesTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

TEST(RawWriterTest, WritesToNoPartitionWithWildcards) {
  BusOptions options = test_options();
  options.input.partitions = {"car1", "car*"};
  EXPECT_THAT([&] { RawWriter(Domain(kReaderDomain, "loopback"), options); },
              testing::ThrowsMessage<BusError>(testing::HasSubstr("partition 'car*'")));
}

}  // namespace
}  // namespace gyrod::bus::test
