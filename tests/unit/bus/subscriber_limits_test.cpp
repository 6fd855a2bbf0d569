/// Where the subscriber's bounds lie: full caches, malformed messages, more sensors than it keeps track of.
#include <gyrod.h>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bus/qos.hpp"
#include "bus/raw_writer.hpp"
#include "bus/subscriber.hpp"
#include "bus/topic_writer.hpp"
#include "unit/bus/subscriber_fixture.hpp"

namespace gyrod::bus::test {
namespace {

class SubscriberLimitsTest : public SubscriberTest {};

std::vector<std::uint64_t> numbers_up_to(std::size_t count) {
  std::vector<std::uint64_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::uint64_t{0});
  return numbers;
}

TEST_P(SubscriberLimitsTest, ASlowReaderHoldsAReliableWriterBackAndLosesNothing) {
  constexpr std::size_t kSamples =
      10'000;  // at 80 bytes and more, beyond what writer (0.5 MB) and reader may buffer
  options_.input_max_messages = 256;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  const std::vector<stream::Sample> samples = make_samples(0, kSamples);
  collector_.set_open(false);
  const std::size_t written = writer.publish("gyro", samples);
  EXPECT_LT(written, kSamples) << "the writer was not held back";
  collector_.set_open(true);
  publish_all(writer, "gyro", std::span(samples).subspan(written));
  ASSERT_TRUE(collector_.wait_for_samples(kSamples));
  EXPECT_EQ(sequence_numbers(collector_.samples("gyro")), numbers_up_to(kSamples));
  EXPECT_GT(subscriber.refusals(), 0U);
}

TEST_P(SubscriberLimitsTest, MalformedMessagesAreCountedAndTheRestPasses) {
  options_.max_batch_samples = 8;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  BusOptions generous = options_;
  generous.max_batch_samples = 64;
  RawWriter writer = matched_writer(generous, 64);
  publish_all(writer, "gyro", make_samples(0, 9));
  publish_all(writer, "gyro", make_samples(0, 8));
  const Domain domain = writer_domain();
  const TopicWriter<gyrod_GyroSample> nameless(domain.participant(), options_.topics.raw,
                                               input_writer_qos(options_));
  wait_until([&] { return nameless.has_readers(); });
  settle(domain, reader_domain());
  EXPECT_EQ(nameless.write(gyrod_GyroSample{}), DDS_RETCODE_OK);
  nameless.flush();
  RawWriter singles = matched_writer(1);
  publish_all(singles, "other", make_samples(0, 1));
  ASSERT_TRUE(collector_.wait_for_samples(9));
  wait_until([&] { return subscriber.malformed_messages() == 2; });
  subscriber.stop();
  EXPECT_EQ(collector_.samples("gyro").size(), 8U);
  EXPECT_EQ(subscriber.malformed_messages(), 2U);
}

TEST_P(SubscriberLimitsTest, TenThousandNewSensorsAllComeThrough) {
  constexpr std::size_t kSensors = 10'000;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  for (std::size_t i = 0; i < kSensors; ++i)
    publish_all(writer, "gyro" + std::to_string(i), make_samples(i, 1));
  EXPECT_TRUE(collector_.wait_for_samples(kSensors));
}

TEST_P(SubscriberLimitsTest, ASensorThatEndsMakesRoomForAnother) {
  options_.max_instances = 2;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "a", make_samples(0, 1));
  publish_all(writer, "b", make_samples(0, 1));
  ASSERT_TRUE(collector_.wait_for_samples(2));
  ASSERT_TRUE(writer.end("a"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  publish_all(writer, "c", make_samples(0, 1));
  EXPECT_TRUE(collector_.wait_for_samples(3));
  EXPECT_EQ(subscriber.refusals(), 0U);
}

TEST_P(SubscriberLimitsTest, ASensorBeyondMaxInstancesIsHeldBackUntilItsWriterGoes) {
  options_.max_instances = 2;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  publish_all(writer, "a", make_samples(0, 1));
  publish_all(writer, "b", make_samples(0, 1));
  ASSERT_TRUE(collector_.wait_for_samples(2));
  {
    RawWriter second = matched_writer(1);
    (void)second.publish("c", make_samples(0, 1));
    wait_until([&] { return subscriber.refusals() > 0; });
    EXPECT_TRUE(collector_.samples("c").empty());
  }
  publish_all(writer, "a", make_samples(1, 1));
  EXPECT_TRUE(collector_.wait_for_samples(3));
  EXPECT_EQ(collector_.samples("a").size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Bus, SubscriberLimitsTest, testing::Values(Route::kInProcess, Route::kUdp),
                         route_name);

}  // namespace
}  // namespace gyrod::bus::test
