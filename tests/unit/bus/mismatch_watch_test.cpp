/// Writers and readers that do not match: who is named, with what, and how often.
#include "bus/mismatch_watch.hpp"

#include <mutex>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bus/log.hpp"
#include "bus/publisher.hpp"
#include "bus/qos.hpp"
#include "bus/subscriber.hpp"
#include "bus/topic_reader.hpp"
#include "unit/bus/subscriber_fixture.hpp"

namespace gyrod::bus::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MismatchWatchTest : public SubscriberTest {
 protected:
  MismatchWatchTest() {
    set_log_handler([this](LogLevel level, std::string_view message) {
      const std::lock_guard lock(mutex_);
      if (level == LogLevel::kWarning) warnings_.emplace_back(message);
    });
  }
  ~MismatchWatchTest() override { set_log_handler({}); }

  [[nodiscard]] std::vector<std::string> warnings() {
    const std::lock_guard lock(mutex_);
    return warnings_;
  }

  [[nodiscard]] static std::size_t peers(const MismatchWatch& watch, std::string_view direction,
                                         std::string_view policy) {
    for (const PeerMismatch& kind : watch.mismatches()) {
      if (kind.direction == direction && kind.policy == policy) return kind.peers;
    }
    ADD_FAILURE() << "no kind " << direction << ' ' << policy;
    return 0;
  }

  static Qos best_effort() {
    Qos qos;
    qos.best_effort().keep_last(8);
    return qos;
  }

  const Domain ours_ = reader_domain();
  const Domain theirs_ = writer_domain();

 private:
  std::mutex mutex_;
  std::vector<std::string> warnings_;
};

TEST_P(MismatchWatchTest, AWriterThatOffersLessIsNamedOnceWithBothValuesAndTheKeyToSet) {
  options_.input_reliability = InputReliability::kReliable;
  options_.input.deadline_s = 0.5;
  const Subscriber subscriber(ours_, options_, collector_);
  const MismatchWatch watch(ours_, options_);
  {
    const TopicWriter<gyrod_GyroSample> writer(theirs_.participant(), options_.topics.raw, best_effort());
    wait_until([&] { return peers(watch, "input", "reliability") == 1U; });
    const Domain another = another_writer_domain();
    const TopicWriter<gyrod_GyroSample> second(another.participant(), options_.topics.raw, best_effort());
    wait_until([&] { return peers(watch, "input", "reliability") == 2U; });
  }
  wait_until([&] { return peers(watch, "input", "reliability") == 0U; });
  ASSERT_EQ(warnings().size(), 2U) << "once each";
  EXPECT_THAT(
      warnings().front(),
      AllOf(HasSubstr("topic '" + options_.topics.raw + "': a writer of 'bus_test' (process " +
                      std::to_string(getpid())),
            HasSubstr(
                "it offers reliability best effort, gyrod asks for reliable, and it offers deadline none, "
                "gyrod asks for 0.5 s"),
            HasSubstr("set bus.input.reliability to \"auto\", and set bus.input.deadline_s to 0")));
}

TEST_P(MismatchWatchTest, AWriterOfAnotherTypeIsNamed) {
  const Subscriber subscriber(ours_, options_, collector_);
  const MismatchWatch watch(ours_, options_);
  const TopicWriter<gyrod_GyroBatch> writer(theirs_.participant(), options_.topics.raw,
                                            input_writer_qos(options_));
  wait_until([&] { return peers(watch, "input", "type") == 1U; });
  ASSERT_EQ(warnings().size(), 1U);
  EXPECT_THAT(warnings().front(), HasSubstr("it has type 'gyrod::GyroBatch', gyrod has 'gyrod::GyroSample'"));
}

TEST_P(MismatchWatchTest, AReaderThatAsksForMoreIsNamed) {
  options_.output_reliability = Reliability::kBestEffort;
  const Publisher publisher(ours_, options_);
  const MismatchWatch watch(ours_, options_);
  Qos reliable;
  reliable.reliable(0).keep_last(8);
  const TopicReader<gyrod_DenoisedSample> reader(theirs_.participant(), options_.topics.denoised, reliable);
  wait_until([&] { return peers(watch, "output", "reliability") == 1U; });
  ASSERT_EQ(warnings().size(), 1U);
  EXPECT_THAT(
      warnings().front(),
      AllOf(HasSubstr("a reader of"), HasSubstr("it asks for reliability reliable, gyrod offers best effort"),
            HasSubstr("set bus.output.reliability to \"reliable\"")));
}

TEST_P(MismatchWatchTest, OursThatOpensLaterIsComparedWithThoseThatAreThere) {
  options_.input_reliability = InputReliability::kReliable;
  const MismatchWatch watch(ours_, options_);
  const TopicWriter<gyrod_GyroSample> writer(theirs_.participant(), options_.topics.raw, best_effort());
  const Subscriber subscriber(ours_, options_, collector_);
  wait_until([&] { return peers(watch, "input", "reliability") == 1U; });
}

TEST_P(MismatchWatchTest, ThoseThatMatchAndThoseInOtherPartitionsAreNotNamed) {
  options_.input.partitions = {"car7"};
  const Subscriber subscriber(ours_, options_, collector_);  // reliability: auto
  const MismatchWatch watch(ours_, options_);
  Qos other = best_effort();
  other.partitions({"car8"});
  const TopicWriter<gyrod_GyroBatch> apart(theirs_.participant(), options_.topics.raw, other);
  Qos same = best_effort();
  same.partitions({"car?"});
  const TopicWriter<gyrod_GyroSample> matched(theirs_.participant(), options_.topics.raw, same);
  Qos wrong;
  wrong.reliable(0).keep_last(1).partitions({"car7"});
  const TopicWriter<gyrod_GyroBatch> marker(theirs_.participant(), options_.topics.raw, wrong);
  wait_until([&] { return peers(watch, "input", "type") == 1U; });
  EXPECT_EQ(peers(watch, "input", "reliability"), 0U);
  EXPECT_EQ(warnings().size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(Bus, MismatchWatchTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
