/// One input for reliable and best-effort writers.
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

using testing::ElementsAre;
using testing::Pair;

/// A sensor's driver that never waits.
class BestEffortWriter {
 public:
  BestEffortWriter(const Domain& domain, const BusOptions& options)
      : domain_(domain), writer_(domain.participant(), options.topics.raw, qos()) {}

  void publish(std::string_view sensor, std::span<const stream::Sample> samples) const {
    gyrod_GyroSample message{};
    set_sensor(message, sensor);
    for (const stream::Sample& sample : samples) {
      to_wire(sample, message);
      EXPECT_EQ(writer_.write(message), DDS_RETCODE_OK);
    }
    writer_.flush();
  }
  [[nodiscard]] bool has_readers() const { return writer_.has_readers(); }

 private:
  static Qos qos() {
    Qos qos;
    qos.best_effort().keep_last(1024).no_autodispose();
    return qos;
  }
  Domain domain_;
  TopicWriter<gyrod_GyroSample> writer_;
};

std::vector<std::uint64_t> numbers(std::uint64_t first, std::size_t count) {
  std::vector<std::uint64_t> all(count);
  std::iota(all.begin(), all.end(), first);
  return all;
}

class AutoReliabilityTest : public SubscriberTest {
 protected:
  [[nodiscard]] BestEffortWriter best_effort_writer() const {
    BestEffortWriter writer(writer_domain(), options_);
    wait_until([&] { return writer.has_readers(); });
    settle(writer_domain(), reader_domain());
    return writer;
  }
};

TEST_P(AutoReliabilityTest, WritersOfBothKindsAreReadAndEachSampleIsHandedOverOnce) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter reliable = matched_writer(1);
  const BestEffortWriter best_effort = best_effort_writer();
  for (std::uint64_t i = 0; i < 50; ++i) {
    publish_all(reliable, "r", make_samples(2 * i, 2));
    best_effort.publish("b", make_samples(i, 1));
    ASSERT_TRUE(collector_.wait_for_samples(3 * (i + 1)));
  }
  subscriber.stop();
  EXPECT_EQ(sequence_numbers(collector_.samples("r")), numbers(0, 100));
  EXPECT_EQ(sequence_numbers(collector_.samples("b")), numbers(0, 50));
}

TEST_P(AutoReliabilityTest, WritersAreCountedOnceAndASecondReaderOpensOnlyForABestEffortOne) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  const Domain domain = writer_domain();
  const TopicWriter<gyrod_GyroSample> reliable(domain.participant(), options_.topics.raw,
                                               input_writer_qos(options_));
  const auto readers = [&reliable] {
    dds_publication_matched_status_t status{};
    (void)dds_get_publication_matched_status(reliable.get(), &status);
    return status.current_count;
  };
  wait_until([&] { return readers() == 1U; });
  const BestEffortWriter best_effort = best_effort_writer();
  wait_until([&] { return readers() == 2U && subscriber.matched_writers() == 2U; });
}

TEST_P(AutoReliabilityTest, ASensorWithAWriterOfEachKindHasTheSamplesOfBothAndEndsWithTheLast) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  RawWriter reliable = matched_writer(1);
  {
    const BestEffortWriter best_effort = best_effort_writer();
    publish_all(reliable, "gyro", make_samples(0, 10));
    ASSERT_TRUE(collector_.wait_for_samples(10));
    best_effort.publish("gyro", make_samples(10, 10));
    ASSERT_TRUE(collector_.wait_for_samples(20));
  }
  publish_all(reliable, "gyro", make_samples(20, 10));
  ASSERT_TRUE(reliable.end("gyro"));
  ASSERT_TRUE(collector_.wait_for_ends(1));
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 30)));
  EXPECT_EQ(sequence_numbers(collector_.samples("gyro")), numbers(0, 30));
}

TEST_P(AutoReliabilityTest, ABestEffortWriterThatGoesEndsItsSensorAfterItsLastSample) {
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  {
    const BestEffortWriter best_effort = best_effort_writer();
    best_effort.publish("gyro", make_samples(0, 10));
    ASSERT_TRUE(collector_.wait_for_samples(10));
    collector_.set_open(false);  // what it writes last is taken when it has gone
    best_effort.publish("gyro", make_samples(10, 10));
    wait_until([&] { return subscriber.matched_writers() == 1U; });
  }
  wait_until([&] { return subscriber.matched_writers() == 0U; });
  collector_.set_open(true);
  ASSERT_TRUE(collector_.wait_for_ends(1));
  // What is on the wire when a writer goes may be lost where nothing is repaired.
  const std::size_t samples = GetParam() == Route::kInProcess ? 20 : collector_.samples("gyro").size();
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", samples)));
}

TEST_P(AutoReliabilityTest, ReliableAsksForReliableWritersOnly) {
  options_.input_reliability = InputReliability::kReliable;
  Subscriber subscriber(reader_domain(), options_, collector_);
  subscriber.start();
  const BestEffortWriter best_effort(writer_domain(), options_);
  const RawWriter reliable = matched_writer(1);
  wait_until([&] { return subscriber.matched_writers() == 1U; });
  EXPECT_FALSE(best_effort.has_readers());
}

TEST_P(AutoReliabilityTest, ARecorderReadsWritersOfBothKinds) {
  const Domain domain = reader_domain();
  Recorder recorder(domain, options_, options_.topics.raw, std::chrono::milliseconds(0));
  RawWriter reliable = matched_writer(1);
  const BestEffortWriter best_effort(writer_domain(), options_);
  RecordCollector rows;
  wait_until([&] {
    (void)recorder.poll(std::chrono::milliseconds(1), rows);
    return best_effort.has_readers();
  });
  publish_all(reliable, "r", make_samples(0, 10));
  best_effort.publish("b", make_samples(0, 10));
  wait_until([&] {
    (void)recorder.poll(std::chrono::milliseconds(1), rows);
    return rows.samples("r").size() + rows.samples("b").size() == 20U;
  });
  EXPECT_EQ(sequence_numbers(rows.samples("r")), numbers(0, 10));
}

INSTANTIATE_TEST_SUITE_P(Bus, AutoReliabilityTest, testing::Values(Route::kInProcess, Route::kUdp),
                         route_name);

}  // namespace
}  // namespace gyrod::bus::test
