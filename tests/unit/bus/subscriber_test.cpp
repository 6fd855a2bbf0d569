/// Raw samples from a writer to the subscriber's handler.
#include "bus/subscriber.hpp"

#include <bit>
#include <limits>

#include <gmock/gmock.h>

#include "bus/bus_error.hpp"
#include "bus/raw_writer.hpp"
#include "unit/bus/subscriber_fixture.hpp"

namespace gyrod::bus::test {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::vector<std::uint64_t> bits_of(const std::vector<stream::Sample>& samples) {
  std::vector<std::uint64_t> bits;
  for (const stream::Sample& sample : samples) {
    bits.push_back(sample.sequence);
    bits.push_back(std::bit_cast<std::uint64_t>(sample.stamp_ns));
    for (const double rate : sample.rate_radps) bits.push_back(std::bit_cast<std::uint64_t>(rate));
  }
  return bits;
}

TEST_P(SubscriberTest, EveryBitOfASampleSurvivesAsSingleAndInABatch) {
  using Limits = std::numeric_limits<double>;
  const std::vector<stream::Sample> samples = {
      {0, std::numeric_limits<std::int64_t>::min(), {-0.0, 0.0, Limits::denorm_min()}},
      {std::numeric_limits<std::uint64_t>::max(), -1, {Limits::max(), Limits::lowest(), Limits::min()}},
      {42, std::numeric_limits<std::int64_t>::max(), {Limits::infinity(), Limits::quiet_NaN(), 0.1}}};
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter singles = matched_writer(1);
  RawWriter batches = matched_writer(8);
  publish_all(singles, "single", samples);
  publish_all(batches, "batch", samples);
  ASSERT_TRUE(collector_.wait_for_samples(2 * samples.size()));
  EXPECT_EQ(bits_of(collector_.samples("single")), bits_of(samples));
  EXPECT_EQ(bits_of(collector_.samples("batch")), bits_of(samples));
}

TEST_P(SubscriberTest, SensorsAreKeptApartAndInOrder) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  const std::string longest(kMaxSensorIdLength, 'z');
  for (std::uint64_t i = 0; i < 100; ++i) {
    publish_all(writer, "a", make_samples(i, 1));
    publish_all(writer, longest, make_samples(1000 + i, 1));
  }
  ASSERT_TRUE(collector_.wait_for_samples(200));
  EXPECT_EQ(bits_of(collector_.samples("a")), bits_of(make_samples(0, 100)));
  EXPECT_EQ(bits_of(collector_.samples(longest)), bits_of(make_samples(1000, 100)));
}

TEST_P(SubscriberTest, AnEndComesAfterTheLastSampleOfEitherTopic) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  RawWriter singles = matched_writer(1);
  RawWriter batches = matched_writer(7);
  publish_all(singles, "single", make_samples(0, 1000));
  publish_all(batches, "batch", make_samples(0, 3000));
  ASSERT_TRUE(singles.end("single"));
  ASSERT_TRUE(batches.end("batch"));
  ASSERT_TRUE(singles.wait_for_acknowledgements(kPatience));
  ASSERT_TRUE(batches.wait_for_acknowledgements(kPatience));
  subscriber.start();  // meets full caches: more than one take, each already showing the sensor as ended
  ASSERT_TRUE(collector_.wait_for_ends(2));
  EXPECT_THAT(collector_.ends(), testing::UnorderedElementsAre(Pair("single", 1000), Pair("batch", 3000)));
}

TEST_P(SubscriberTest, ASensorOnBothTopicsEndsWhenBothHaveEnded) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter singles = matched_writer(1);
  RawWriter batches = matched_writer(8);
  publish_all(singles, "gyro", make_samples(0, 10));
  publish_all(batches, "gyro", make_samples(10, 8));
  ASSERT_TRUE(collector_.wait_for_samples(18));
  ASSERT_TRUE(singles.end("gyro"));
  publish_all(batches, "gyro", make_samples(18, 8));
  ASSERT_TRUE(collector_.wait_for_samples(26));
  ASSERT_TRUE(batches.end("gyro"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 26)));
}

TEST_P(SubscriberTest, AWriterThatGoesAwayEndsItsSensors) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  {
    RawWriter writer = matched_writer(1);
    publish_all(writer, "gyro", make_samples(0, 100));
  }
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 100)));
  // The end may be told before the reader's own count of writers has gone down.
  wait_until([&] { return subscriber.matched_writers() == 0U; });
}

TEST_P(SubscriberTest, ASensorWithASecondWriterDoesNotEndWithTheFirst) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter standby = matched_writer(1);
  {
    RawWriter writer = matched_writer(1);
    publish_all(writer, "gyro", make_samples(0, 10));
    publish_all(standby, "gyro", make_samples(10, 10));
    ASSERT_TRUE(collector_.wait_for_samples(20));
    ASSERT_TRUE(writer.end("gyro"));
  }
  publish_all(standby, "gyro", make_samples(20, 10));
  ASSERT_TRUE(standby.end("gyro"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 30)));
}

TEST_P(SubscriberTest, ASensorThatCameBackBeforeItsEndWasSeenHasNotEnded) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  RawWriter writer = matched_writer(1);
  publish_all(writer, "gyro", make_samples(0, 10));
  ASSERT_TRUE(writer.end("gyro"));
  publish_all(writer, "gyro", make_samples(10, 10));
  ASSERT_TRUE(writer.wait_for_acknowledgements(kPatience));
  subscriber.start();
  ASSERT_TRUE(collector_.wait_for_samples(20));
  ASSERT_TRUE(writer.end("gyro"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 20)));
}

TEST_P(SubscriberTest, ASensorThatComesBackLaterEndsAgain) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  for (std::size_t life = 1; life <= 2; ++life) {
    publish_all(writer, "gyro", make_samples(0, 10));
    ASSERT_TRUE(writer.end("gyro"));
    ASSERT_TRUE(collector_.wait_for_ends(life));
  }
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 10), Pair("gyro", 20)));
}

TEST_P(SubscriberTest, StopHandsOverWhatTheCachesHold) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  collector_.set_open(false);
  publish_all(writer, "gyro", make_samples(0, 2000));
  ASSERT_TRUE(writer.wait_for_acknowledgements(kPatience));
  collector_.set_open(true);
  subscriber.stop();
  EXPECT_EQ(collector_.samples("gyro").size(), 2000U);
  subscriber.stop();
}

TEST_P(SubscriberTest, StopComesBackUnderAWriterThatNeverPauses) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  std::atomic<bool> done{false};
  std::thread sender([&] {
    for (std::uint64_t i = 0; !done; i += 64) (void)writer.publish("gyro", make_samples(i, 64));
  });
  EXPECT_TRUE(collector_.wait_for_samples(1000));
  subscriber.stop();
  done = true;
  sender.join();
}

TEST_P(SubscriberTest, ABestEffortKeepLastInputIsFedByAReliableWriter) {
  options_.input_reliability = InputReliability::kBestEffort;
  options_.input_history = History::kKeepLast;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter writer = matched_writer(1);
  // Without repair the first ones may be lost while the reader is still learning of the writer.
  for (std::uint64_t i = 0; i < 10'000 && collector_.samples("gyro").empty(); ++i) {
    publish_all(writer, "gyro", make_samples(i, 1));
    std::this_thread::yield();
  }
  EXPECT_TRUE(collector_.wait_for_samples(1));
}

INSTANTIATE_TEST_SUITE_P(Bus, SubscriberTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

TEST(RawWriterTest, NamesASensorIdThatDoesNotFit) {
  RawWriter writer(Domain(kReaderDomain, "loopback"), test_options());
  const std::string too_long(kMaxSensorIdLength + 1, 'x');
  EXPECT_THROW((void)writer.publish("", make_samples(0, 1)), BusError);
  try {
    (void)writer.publish(too_long, make_samples(0, 1));
    FAIL() << "accepted";
  } catch (const BusError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(too_long));
  }
}

TEST(RawWriterTest, WaitingForASubscriberThatNeverComesEnds) {
  RawWriter writer(Domain(kReaderDomain, "loopback"), test_options());
  EXPECT_FALSE(writer.wait_for_subscriber(std::chrono::milliseconds(20)));
}

TEST(RawWriterTest, RefusesABatchThatGyrodWouldRefuse) {
  BusOptions options = test_options();
  EXPECT_THROW(RawWriter(Domain(kReaderDomain, "loopback"), options, options.max_batch_samples + 1),
               BusError);
  EXPECT_THROW(RawWriter(Domain(kReaderDomain, "loopback"), options, 0), BusError);
}

}  // namespace
}  // namespace gyrod::bus::test
