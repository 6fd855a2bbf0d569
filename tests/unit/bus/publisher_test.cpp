/// Denoised samples and reports from the publisher to readers.
#include "bus/publisher.hpp"

#include <atomic>
#include <thread>

#include <gmock/gmock.h>

#include "bus/bus_error.hpp"
#include "bus/raw_writer.hpp"
#include "bus/recorder.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

std::vector<stream::DenoisedSample> make_denoised(std::uint64_t first, std::size_t count) {
  std::vector<stream::DenoisedSample> samples;
  for (const stream::Sample& raw : make_samples(first, count)) {
    stream::DenoisedSample sample{raw.sequence, raw.stamp_ns, raw.rate_radps};
    sample.rate_std_radps = {0.125 * static_cast<double>(raw.sequence), 0.0, 1e-309};
    sample.flags = static_cast<std::uint32_t>(raw.sequence % 32);
    sample.noise_source = static_cast<stream::NoiseSource>(raw.sequence % 4);
    sample.noise_floor_radps = {0.5, -0.0, 1e-310};
    sample.model_epoch = raw.sequence / 32;
    samples.push_back(sample);
  }
  return samples;
}

void expect_same(const std::vector<stream::DenoisedSample>& actual,
                 const std::vector<stream::DenoisedSample>& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_EQ(actual[i].sequence, expected[i].sequence);
    EXPECT_EQ(actual[i].stamp_ns, expected[i].stamp_ns);
    EXPECT_EQ(actual[i].rate_radps, expected[i].rate_radps);
    EXPECT_EQ(actual[i].rate_std_radps, expected[i].rate_std_radps);
    EXPECT_EQ(actual[i].flags, expected[i].flags);
    EXPECT_EQ(actual[i].noise_source, expected[i].noise_source);
    EXPECT_EQ(actual[i].noise_floor_radps, expected[i].noise_floor_radps);
    EXPECT_EQ(actual[i].model_epoch, expected[i].model_epoch);
  }
}

class PublisherTest : public BusTest {
 protected:
  /// A recorder that a writer of its topic has found.
  [[nodiscard]] Recorder matched_recorder(const std::string& topic) {
    Recorder recorder(reader_domain(), options_, topic, kPatience);
    wait_until([&] { return recorder.matched_writers() > 0; });
    return recorder;
  }

  /// Publishes until the recorder got something: the publisher skips a topic whose readers it has not found
  /// yet.
  static void publish_first(Publisher& publisher, Recorder& recorder, RecordCollector& collector) {
    wait_until([&] {
      publisher.publish("first", make_denoised(0, 1));
      return recorder.poll(std::chrono::milliseconds(1), collector) == Recorder::Poll::kSamples;
    });
  }

  static void poll_until(Recorder& recorder, RecordCollector& collector, Recorder::Poll result) {
    wait_until([&] { return recorder.poll(std::chrono::milliseconds(100), collector) == result; });
  }

  static void poll_until_samples(Recorder& recorder, RecordCollector& collector, const std::string& sensor,
                                 std::size_t count) {
    wait_until([&] {
      (void)recorder.poll(std::chrono::milliseconds(100), collector);
      return collector.samples(sensor).size() >= count;
    });
  }

  RecordCollector collector_;
};

TEST_P(PublisherTest, EveryFieldSurvivesAsSingleAndInABatch) {
  options_.max_batch_samples = 24;  // 100 samples go out as four full batches and a rest
  Publisher publisher(writer_domain(), options_);
  for (const std::string& topic : {options_.topics.denoised, options_.topics.denoised_batch}) {
    RecordCollector collector;
    Recorder recorder = matched_recorder(topic);
    publish_first(publisher, recorder, collector);
    publisher.publish("gyro", make_denoised(7, 100));
    poll_until_samples(recorder, collector, "gyro", 100);
    expect_same(collector.samples("gyro"), make_denoised(7, 100));
  }
  EXPECT_EQ(publisher.write_errors(), 0U);
}

TEST_P(PublisherTest, EstimatesWithoutLookAheadHaveTopicsOfTheirOwnAndEndWithTheSensor) {
  options_.realtime = true;
  Publisher publisher(writer_domain(), options_);
  for (const std::string& topic : {options_.topics.realtime, options_.topics.realtime_batch}) {
    RecordCollector collector;
    Recorder recorder = matched_recorder(topic);
    wait_until([&] {
      publisher.publish("lagged", make_denoised(0, 1));
      publisher.publish_realtime("first", make_denoised(0, 1));
      return recorder.poll(std::chrono::milliseconds(1), collector) == Recorder::Poll::kSamples;
    });
    publisher.publish_realtime("gyro", make_denoised(7, 100));
    publisher.unregister_sensor("gyro");
    wait_until([&] {
      (void)recorder.poll(std::chrono::milliseconds(100), collector);
      return !collector.ends().empty();
    });
    expect_same(collector.samples("gyro"), make_denoised(7, 100));
    EXPECT_THAT(collector.ends(), ElementsAre(Pair("gyro", 100)));
    EXPECT_TRUE(collector.samples("lagged").empty());
  }
  EXPECT_TRUE(publisher.wait_for_acknowledgements(kPatience));
  EXPECT_EQ(publisher.write_errors(), 0U);
}

TEST_P(PublisherTest, ATopicWithoutLookAheadIsNotOfferedUnasked) {
  Publisher publisher(writer_domain(), options_);
  BusOptions renamed = options_;  // so that the topic is not known by its name
  renamed.topics.realtime = "unused";
  EXPECT_THROW(Recorder(reader_domain(), renamed, options_.topics.realtime, std::chrono::milliseconds(20)),
               BusError);
}

TEST_P(PublisherTest, RecordersSeeTheEndOfASensorAfterItsSamples) {
  Publisher publisher(writer_domain(), options_);
  Recorder recorder = matched_recorder(options_.topics.denoised);
  publish_first(publisher, recorder, collector_);
  publisher.publish("gyro", make_denoised(0, 500));
  publisher.unregister_sensor("gyro");
  wait_until([&] {
    (void)recorder.poll(std::chrono::milliseconds(100), collector_);
    return !collector_.ends().empty();
  });
  EXPECT_THAT(collector_.ends(), ElementsAre(Pair("gyro", 500)));
}

TEST_P(PublisherTest, ARecorderTellsThatTheLastWriterHasGone) {
  Recorder recorder = [&] {
    Publisher publisher(writer_domain(), options_);
    Recorder matched = matched_recorder(options_.topics.denoised_batch);
    publish_first(publisher, matched, collector_);
    publisher.publish("gyro", make_denoised(0, 40));
    return matched;
  }();
  poll_until(recorder, collector_, Recorder::Poll::kEnded);
  EXPECT_EQ(collector_.samples("gyro").size(), 40U);
}

TEST_P(PublisherTest, ThreadsPublishDifferentSensorsAtOnce) {
  constexpr std::size_t kThreads = 4;
  constexpr std::size_t kCalls = 50;
  constexpr std::size_t kHop = 32;
  options_.output_depth = kCalls * kHop;  // nothing may be overwritten while the test looks elsewhere
  Publisher publisher(writer_domain(), options_);
  Recorder recorder = matched_recorder(options_.topics.denoised);
  publish_first(publisher, recorder, collector_);
  std::vector<std::thread> workers;
  for (std::size_t t = 0; t < kThreads; ++t) {
    workers.emplace_back([&publisher, t] {
      for (std::size_t call = 0; call < kCalls; ++call) {
        publisher.publish("gyro" + std::to_string(t), make_denoised(call * kHop, kHop));
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  for (std::size_t t = 0; t < kThreads; ++t) {
    const std::string sensor = "gyro" + std::to_string(t);
    poll_until_samples(recorder, collector_, sensor, kCalls * kHop);
    expect_same(collector_.samples(sensor), make_denoised(0, kCalls * kHop));
  }
}

TEST_P(PublisherTest, ATopicOfUnknownNameIsReadByTheTypeItsWriterShows) {
  BusOptions elsewhere = options_;
  elsewhere.topics.raw_batch = options_.topics.raw + "/elsewhere";
  RawWriter writer(writer_domain(), elsewhere, 16);
  Recorder recorder(reader_domain(), options_, elsewhere.topics.raw_batch, kPatience);
  EXPECT_EQ(recorder.type_name(), "gyrod::GyroBatch");
  ASSERT_TRUE(writer.wait_for_subscriber(kPatience));
  settle(writer_domain(), reader_domain());
  const std::vector<stream::Sample> samples = make_samples(3, 40);
  ASSERT_EQ(writer.publish("gyro", samples), samples.size());
  poll_until_samples(recorder, collector_, "gyro", samples.size());
  EXPECT_EQ(sequence_numbers(collector_.samples("gyro")), sequence_numbers(samples));
  EXPECT_EQ(collector_.samples("gyro").back().rate_radps, samples.back().rate_radps);
  EXPECT_EQ(collector_.samples("gyro").back().flags, 0U);
}

TEST_P(PublisherTest, ATopicOfAnotherTypeIsNamedWithItsType) {
  Publisher publisher(writer_domain(), options_);  // its noise topic has no samples
  BusOptions other = options_;
  other.topics.noise = "unused";
  try {
    Recorder recorder(reader_domain(), other, options_.topics.noise, kPatience);
    FAIL() << "accepted";
  } catch (const BusError& error) {
    EXPECT_THAT(error.what(), HasSubstr(options_.topics.noise));
    EXPECT_THAT(error.what(), HasSubstr("gyrod::NoiseReport"));
  }
}

TEST_P(PublisherTest, ATopicWithoutAWriterIsNamed) {
  try {
    Recorder recorder(reader_domain(), options_, "no/such/topic", std::chrono::milliseconds(20));
    FAIL() << "accepted";
  } catch (const BusError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/such/topic"));
  }
}

INSTANTIATE_TEST_SUITE_P(Bus, PublisherTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
