// A sensor that comes from another daemon, or goes to it, as the engine and its sink see it.
#include "app/engine_feed.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/recording_sink.hpp"
#include "support/samples.hpp"
#include "support/toy_methods.hpp"

namespace gyrod::app {
namespace {

using testing::counting_samples;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::string kSensor = "imu";
const fleet::ServingRule kAll{{1, 1}, true};
/// Leaves everything to others.
const fleet::ServingRule kNothing{{1, 1}, true, {{1, 2}, {2, 2}}};

/// Leaves to others a shard of three that the sensor is not in.
fleet::ServingRule all_but_others() {
  std::uint32_t index = 1;
  while (fleet::holds({index, 3}, kSensor)) ++index;
  return {{1, 1}, true, {{index, 3}}};
}

stream::EngineOptions options() {
  stream::EngineOptions options;
  options.window_samples = 64;
  options.hop_samples = 8;
  options.max_hop_samples = 16;
  options.lag_samples = 8;
  options.workers = 0;
  return options;
}

class EngineInletTest : public ::testing::Test {
 protected:
  /// Sequence numbers, from the first on.
  bus::Fate push(std::size_t count, std::uint64_t first) {
    return inlet_.push(kSensor, counting_samples(count, first));
  }
  std::vector<std::uint64_t> published() {
    engine_.stop(std::chrono::seconds{60});
    std::vector<std::uint64_t> sequences;
    std::ranges::transform(sink_.samples(kSensor), std::back_inserter(sequences),
                           &stream::DenoisedSample::sequence);
    return sequences;
  }

  testing::RecordingSink sink_;
  stream::Engine engine_{options(), testing::window_marker(), sink_};
  live::Tap tap_;
  EngineInlet inlet_{engine_, tap_};
};

TEST_F(EngineInletTest, GoesOnBehindTheMarkWithWhatItHasKept) {
  inlet_.serve(kNothing, true);
  EXPECT_EQ(push(5, 1), bus::Fate::kMayLeave);
  inlet_.heed(std::vector<bus::GivenUp>{{kSensor, {3, counting_samples(1, 3)[0].stamp_ns}}});
  EXPECT_THAT(inlet_.serve(kAll, true), IsEmpty());
  EXPECT_EQ(push(2, 6), bus::Fate::kLeaves);
  EXPECT_THAT(published(), ElementsAre(4, 5, 6, 7));
}

TEST_F(EngineInletTest, GoesOnBehindTheMarkWhereNothingHadComeYet) {
  inlet_.serve(kNothing, true);
  inlet_.heed(std::vector<bus::GivenUp>{{kSensor, {3, counting_samples(1, 3)[0].stamp_ns}}});
  inlet_.serve(kAll, true);
  EXPECT_EQ(push(2, 2), bus::Fate::kDoesNot);
  EXPECT_EQ(push(2, 4), bus::Fate::kLeaves);
  EXPECT_THAT(published(), ElementsAre(4, 5));
}

TEST_F(EngineInletTest, TellsUpToWhereItServedWhatItGivesUpAndServesItNoMore) {
  push(5, 1);
  const std::vector<bus::GivenUp> expected = {{kSensor, {5, counting_samples(1, 5)[0].stamp_ns}}};
  EXPECT_EQ(inlet_.served(), expected);
  EXPECT_EQ(inlet_.serve(kNothing, true), expected);
  EXPECT_THAT(inlet_.served(), IsEmpty());
  EXPECT_EQ(push(1, 6), bus::Fate::kMayLeave);
  EXPECT_THAT(published(), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(inlet_.foreign(), 1U);
}

TEST_F(EngineInletTest, WhatATwinHasServedIsServedHereAllTheSame) {
  push(5, 1);
  inlet_.heed(std::vector<bus::GivenUp>{{kSensor, {8, counting_samples(1, 8)[0].stamp_ns}}});
  EXPECT_EQ(push(5, 6), bus::Fate::kLeaves);
  EXPECT_THAT(published(), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

TEST_F(EngineInletTest, AMarkIsOfNoUseOnceTheSensorHasEnded) {
  inlet_.serve(kNothing, true);
  inlet_.heed(std::vector<bus::GivenUp>{{kSensor, {8, counting_samples(1, 8)[0].stamp_ns}}});
  inlet_.serve(kAll, true);
  inlet_.end(kSensor);
  EXPECT_EQ(push(3, 1), bus::Fate::kLeaves) << "a recording that is sent once more";
  EXPECT_THAT(published(), ElementsAre(1, 2, 3));
}

// As of a daemon that was killed: what may have been sent before is left out by time, and what was kept is, too.
TEST_F(EngineInletTest, LeavesOutByTimeWhatNobodyHasToldOf) {
  inlet_.serve(kNothing, true);
  push(5, 1);
  inlet_.serve(kAll, false);
  EXPECT_EQ(push(1, 6), bus::Fate::kDoesNot);
  inlet_.serve(all_but_others(), true);
  inlet_.serve(kAll, true);
  EXPECT_EQ(push(1, 7), bus::Fate::kDoesNot) << "whatever else has changed";
  EXPECT_THAT(published(), IsEmpty());
}

}  // namespace
}  // namespace gyrod::app
