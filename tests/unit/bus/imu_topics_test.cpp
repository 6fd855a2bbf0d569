/// ROS 2 topics between a publisher and a handler that stands for the engine.
#include "bus/imu_topics.hpp"

#include <thread>

#include <gmock/gmock.h>

#include "bus/bus_error.hpp"
#include "bus/entity.hpp"
#include "bus/imu_subscriber.hpp"
#include "bus/loan.hpp"
#include "bus/qos.hpp"
#include "bus/topic_writer.hpp"
#include "support/eventually.hpp"
#include "support/imu_node.hpp"
#include "unit/bus/imu_topics_fixture.hpp"

namespace gyrod::bus::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::imu_message;
using testing::ImuPublisher;
using ::testing::IsEmpty;

TEST_P(ImuTopicsTest, AMessageThatIsNotAcceptedIsGivenUpAndTheOthersKeepTheirFields) {
  options_.ros2.topics = {topic("imu")};
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const auto output = subscription(topics, "imu_denoised");
  const auto writer = publisher(topics, "imu");
  const std::vector<testing::ImuMessage> sent = {imu_message(1, 10, {1.0, 0.0, 0.0}),
                                                 imu_message(2, 20, {-1.0, 0.0, 0.0}),
                                                 imu_message(3, 20, {1.0, 0.0, 0.0})};
  for (const auto& message : sent) writer->publish(message);
  ASSERT_TRUE(handler_.collector().wait_for_samples(3));
  subscriber.stop();
  EXPECT_TRUE(topics.publish(topic("imu"), std::vector{denoised(10), denoised(20)}));
  ASSERT_TRUE(output->wait_for(2));
  EXPECT_EQ(untouched_bits(output->messages()[0]), untouched_bits(sent[0]));
  EXPECT_EQ(untouched_bits(output->messages()[1]), untouched_bits(sent[2]))
      << "not the refused one with its stamp";
  EXPECT_FALSE(topics.publish(topic("other"), std::vector{denoised(10)}));
  EXPECT_EQ(topics.snapshot().dropped_messages, 0U);
}

TEST_P(ImuTopicsTest, NoMoreMessagesWaitThanThereIsRoomForAndTheRestIsCounted) {
  options_.ros2.topics = {topic("imu")};
  options_.ros2.max_held_messages = 4;
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const auto writer = publisher(topics, "imu");
  testing::ImuMessage wordy = imu_message(0, 1, {1.0, 0.0, 0.0});
  wordy.frame_id = std::string(256, 'f');
  writer->publish(wordy);
  wordy.frame_id.pop_back();  // 255 are allowed
  wordy.fields.header.stamp.nanosec = 2;
  writer->publish(wordy);
  for (std::uint64_t n = 3; n < 10; ++n)
    writer->publish(imu_message(n, static_cast<std::int64_t>(n), {1.0, 0.0, 0.0}));
  wait_until([&] { return topics.snapshot().dropped_messages == 4; });
  EXPECT_EQ(topics.snapshot().malformed_messages, 1U);
  EXPECT_EQ(handler_.collector().samples(topic("imu")).size(), 4U);
}

TEST_P(ImuTopicsTest, WhatAnotherDaemonServesWaitsWhileThereIsRoomAndIsNotMissed) {
  options_.ros2.topics = {topic("imu")};
  options_.ros2.max_held_messages = 4;
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const auto output = subscription(topics, "imu_denoised");
  const auto realtime = subscription(topics, "imu_realtime");
  const auto writer = publisher(topics, "imu");
  std::vector<testing::ImuMessage> sent;
  for (std::uint64_t n = 0; n < 6; ++n)
    sent.push_back(imu_message(n, static_cast<std::int64_t>(n), {1.0, -1.0, 0.0}));
  sent.push_back(imu_message(6, 6, {1.0, 0.0, 0.0}));
  for (const auto& message : sent) writer->publish(message);
  ASSERT_TRUE(handler_.collector().wait_for_samples(7));
  subscriber.stop();
  // This daemon goes on behind the fifth, before it takes the seventh.
  topics.publish_realtime(topic("imu"), std::vector{denoised(5), denoised(6)});
  topics.publish(topic("imu"), std::vector{denoised(5), denoised(6)});
  for (const auto* estimate : {&output, &realtime}) {
    ASSERT_TRUE((*estimate)->wait_for(2));
    EXPECT_EQ(untouched_bits((*estimate)->messages()[0]), untouched_bits(sent[5]));
    EXPECT_EQ(untouched_bits((*estimate)->messages()[1]), untouched_bits(sent[6]));
  }
  EXPECT_EQ(topics.snapshot().dropped_messages, 0U);
}

TEST_P(ImuTopicsTest, ASampleWhoseMessageHasGoneIsCountedAndTakesNoOtherAlong) {
  options_.ros2.topics = {topic("imu")};
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const auto output = subscription(topics, "imu_denoised");
  const auto writer = publisher(topics, "imu");
  for (std::int64_t n = 10; n < 13; ++n)
    writer->publish(imu_message(static_cast<std::uint64_t>(n), n, {1.0, 0.0, 0.0}));
  ASSERT_TRUE(handler_.collector().wait_for_samples(3));
  subscriber.stop();
  topics.publish(topic("imu"),
                 std::vector{denoised(8), denoised(9), denoised(10), denoised(11), denoised(12)});
  ASSERT_TRUE(output->wait_for(3));
  EXPECT_EQ(topics.snapshot().dropped_messages, 2U);
}

TEST_P(ImuTopicsTest, ReliableAndBestEffortPublishersAreReadAndEachMessageOnce) {
  options_.ros2.topics = {topic("imu")};
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const auto best_effort = publisher(topics, "imu");
  const ImuPublisher reliable(writer_domain_.participant(), topic("imu"), true);
  wait_until([&] { return topics.snapshot().matched_writers == 2; });
  ASSERT_TRUE(reliable.wait_for_reader());
  for (std::uint64_t n = 0; n < 20; ++n) {
    best_effort->publish(imu_message(2 * n, static_cast<std::int64_t>(2 * n), {-1.0, 0.0, 0.0}));
    reliable.publish(imu_message(2 * n + 1, static_cast<std::int64_t>(2 * n + 1), {-1.0, 0.0, 0.0}));
    ASSERT_TRUE(handler_.collector().wait_for_samples(2 * n + 2));
  }
  subscriber.stop();
  EXPECT_EQ(handler_.collector().samples(topic("imu")).size(), 40U);
}

TEST_P(ImuTopicsTest, APublisherThatMissesItsDeadlineIsTold) {
  options_.ros2.topics = {topic("imu")};
  options_.ros2.input.deadline_s = options_.ros2.output.deadline_s = 0.2;
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const TopicWriter<sensor_msgs_msg_dds__Imu_> writer(writer_domain_.participant(), topic("imu"),
                                                      imu_writer_qos(options_));
  wait_until([&] { return writer.has_readers() && topics.snapshot().matched_writers == 1; });
  settle(writer_domain_, reader_domain_);
  testing::ImuMessage message = imu_message(1, 10, {-1.0, 0.0, 0.0});
  message.fields.header.frame_id = message.frame_id.data();
  EXPECT_EQ(writer.write(message.fields), DDS_RETCODE_OK);
  writer.flush();
  ASSERT_TRUE(handler_.collector().wait_for_broken_promises(1));
  EXPECT_EQ(handler_.collector().broken_promises().front(),
            std::pair(topic("imu"), stream::ChannelState::kDeadlineMissed));
  EXPECT_GE(topics.snapshot().broken_promises.deadlines_missed, 1U);
}

TEST_P(ImuTopicsTest, ATopicEndsWhenItsLastPublisherHasGone) {
  options_.ros2.topics = {topic("imu")};
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  auto first = publisher(topics, "imu");
  auto second = publisher(topics, "imu");
  for (const auto* of : {first.get(), second.get()}) of->publish(imu_message(1, 0, {-1.0, 0.0, 0.0}));
  ASSERT_TRUE(handler_.collector().wait_for_samples(2));
  first.reset();
  wait_until([&] { return topics.snapshot().matched_writers == 1; });
  second->publish(imu_message(1, 0, {-1.0, 0.0, 0.0}));
  ASSERT_TRUE(handler_.collector().wait_for_samples(3));
  EXPECT_THAT(handler_.collector().ends(), IsEmpty()) << "there was another publisher";
  second.reset();
  ASSERT_TRUE(handler_.collector().wait_for_ends(1));
  EXPECT_THAT(handler_.collector().ends(), ElementsAre(::testing::Pair(topic("imu"), 3)));
}

TEST_P(ImuTopicsTest, APatternOpensWhatHasTheTypeAndARoomAndOutputsOfItsOwn) {
  options_.ros2.topics = {topic("*")};
  ImuTopics topics(reader_domain_, options_);
  ImuSubscriber subscriber(topics, handler_);
  subscriber.start();
  const TopicWriter<gyrod_GyroSample> other_type(writer_domain_.participant(), topic("other_type"),
                                                 input_writer_qos(options_));
  const ImuPublisher output(writer_domain_.participant(), topic("imu_realtime"));
  const ImuPublisher deeper(writer_domain_.participant(), topic("a/imu"));
  const auto wanted = publisher(topics, "imu_raw");
  EXPECT_THAT(handler_.opened(), ElementsAre(topic("imu_raw")));
  const ImuPublisher same_outputs(writer_domain_.participant(), topic("imu"));
  const ImuPublisher long_name(writer_domain_.participant(), topic(std::string(kMaxSensorIdLength, 'a')));
  wait_until([&] { return handler_.refused().size() == 2; });
  EXPECT_THAT(handler_.refused(), ::testing::UnorderedElementsAre(
                                      HasSubstr("its output '" + topic("imu_denoised") + "' is that of"),
                                      HasSubstr("a sensor's id has at most 64")));
  EXPECT_EQ(topics.snapshot().refused_topics, 2U);
  EXPECT_EQ(topics.snapshot().topics, 1U);
  EXPECT_TRUE(topics.claims(topic("imu_raw")));
  EXPECT_TRUE(topics.claims(topic("not_there_yet")));
  EXPECT_FALSE(topics.claims(topic("imu_denoised")));
  EXPECT_FALSE(topics.claims("imu"));
}

TEST_P(ImuTopicsTest, OutputsShowTheTypeAndTheHashOfRos2) {
  options_.ros2.topics = {topic("imu")};
  const ImuTopics topics(reader_domain_, options_);
  const Entity publications(
      dds_create_reader(writer_domain_.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
      "look");
  std::string type;
  std::string user_data;
  wait_until([&] {
    const Loan<dds_builtintopic_endpoint_t> loan(publications.get());
    for (std::size_t i = 0; i < loan.size(); ++i) {
      if (!loan.info(i).valid_data || loan.message(i).topic_name != topic("imu_denoised")) continue;
      type = loan.message(i).type_name;
      void* text = nullptr;
      std::size_t size = 0;
      if (dds_qget_userdata(loan.message(i).qos, &text, &size)) user_data = {static_cast<char*>(text), size};
      dds_free(text);
    }
    return !type.empty();
  });
  EXPECT_EQ(type, "sensor_msgs::msg::dds_::Imu_");
  // The hash is that of sensor_msgs/msg/Imu in every release of ROS 2 that has hashes, as ros2 topic info -v shows it.
  EXPECT_EQ(user_data, "typehash=RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b;");
}

TEST_P(ImuTopicsTest, MoreNamedTopicsThanAreAllowedAreAnErrorThatNamesTheFirst) {
  options_.ros2.topics = {topic("imu")};
  options_.ros2.max_topics = 1;
  options_.ros2.topics.push_back(topic("imu2"));
  try {
    const ImuTopics topics(reader_domain_, options_);
    FAIL() << "opened";
  } catch (const BusError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("open ROS 2 topic '" + topic("imu2") + "': 1 are open, no more are allowed"));
  }
}

INSTANTIATE_TEST_SUITE_P(Bus, ImuTopicsTest, ::testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
