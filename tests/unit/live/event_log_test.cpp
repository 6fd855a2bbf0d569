#include "live/event_log.hpp"

#include <string>

#include <gtest/gtest.h>

namespace gyrod::live {
namespace {

using stream::Health;

stream::SensorHealth health(Health x, Health y, Health z) {
  stream::SensorHealth made;
  made.axis[0].state = x;
  made.axis[1].state = y;
  made.axis[2].state = z;
  return made;
}

TEST(EventLog, KeepsTheNewestAndGoesOnCounting) {
  EventLog log;
  for (std::size_t i = 1; i <= EventLog::kCapacity + 10; ++i) {
    log.add(1.0, "", std::to_string(i));
    if (i % 100 == 0) log.settle();
  }
  const EventLog::Page page = log.read({});
  EXPECT_EQ(page.first_id, 11U);
  EXPECT_EQ(page.last_id, EventLog::kCapacity + 10);
  EXPECT_EQ(page.events.size(), EventLog::kCapacity);
  EXPECT_EQ(page.events.front().text, "11");
}

TEST(EventLog, AFloodThatNobodyTakesInIsBounded) {
  EventLog log;
  for (std::size_t i = 1; i <= EventLog::kCapacity + 10; ++i) log.add(1.0, "", std::to_string(i));
  EXPECT_EQ(log.last_id(), EventLog::kCapacity);
}

TEST(EventLog, AChangeOfAllAxesAlikeIsOneEvent) {
  EventLog log;
  log.add_health(1.0, "imu", health(Health::kOk, Health::kOk, Health::kOk),
                 health(Health::kSilent, Health::kSilent, Health::kSilent));
  ASSERT_EQ(log.read({}).events.size(), 1U);
  EXPECT_FALSE(log.read({}).events[0].health->axis.has_value());
}

TEST(EventLog, AxesThatChangeByThemselvesAreEventsByThemselves) {
  EventLog log;
  log.add_health(1.0, "imu", health(Health::kOk, Health::kOk, Health::kStuck),
                 health(Health::kNoisy, Health::kOk, Health::kSaturated));
  const auto events = log.read({}).events;
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].health->axis, 0U);
  EXPECT_EQ(events[0].health->to, Health::kNoisy);
  EXPECT_EQ(events[1].health->axis, 2U);
  EXPECT_EQ(events[1].health->from, Health::kStuck);
}

// As docs/health.md has value and limit of each state.
TEST(EventLog, TheEvidenceIsInWords) {
  EXPECT_EQ(evidence_words({Health::kSilent, 1.25, 1.0}), "no sample for 1.25 s, limit 1 s");
  EXPECT_EQ(evidence_words({Health::kSilent, 0.0, 1.0}), "its writer is gone, or has missed a deadline");
  EXPECT_EQ(evidence_words({Health::kStuck, 1.5, 1.0}), "one value for 1.5 s, limit 1 s");
  EXPECT_EQ(evidence_words({Health::kSaturated, 0.5, 10.0}), "at the end of its range 0.5 s ago, limit 10 s");
  EXPECT_EQ(evidence_words({Health::kNoisy, 1.7, 1.5}), "1.7 times its usual noise, limit 1.5");
  EXPECT_EQ(evidence_words({Health::kDrifting, 2e-3, 1e-3}), "bias off by 0.002 rad/s, limit 0.001 rad/s");
  EXPECT_EQ(evidence_words({Health::kLossy, 0.05, 0.01}), "5 % of samples missing or refused, limit 1 %");
  EXPECT_EQ(evidence_words({Health::kDegraded, 2.0, 1.0}), "overload step 2 of 2");
  EXPECT_EQ(evidence_words({Health::kWarmingUp, 100.0, 1024.0}), "100 of 1024 samples of its window");
  EXPECT_EQ(evidence_words({Health::kOk, 0.0, 0.0}), "");
}

TEST(EventLog, WithoutAChangeThereIsNoEvent) {
  EventLog log;
  log.add_health(1.0, "imu", {}, {});
  EXPECT_EQ(log.last_id(), 0U);
  EXPECT_EQ(log.read({}).first_id, 0U);
}

TEST(EventLog, ReadsOnFromAnIdOrTheNewest) {
  EventLog log;
  for (const char* sensor : {"a", "b", "a", "b", "a"}) log.add(1.0, sensor, sensor);
  EXPECT_EQ(log.read({.after = 2, .limit = 2}).events.front().id, 3U);
  EXPECT_EQ(log.read({.after = 2, .limit = 2}).events.size(), 2U);
  EXPECT_EQ(log.read({.sensor = "b"}).events.size(), 2U);
  EXPECT_EQ(log.read({.limit = 1, .sensor = "b", .newest = true}).events.front().id, 4U);
  EXPECT_TRUE(log.read({.after = 99}).events.empty());
}

}  // namespace
}  // namespace gyrod::live
