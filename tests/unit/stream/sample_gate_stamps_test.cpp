// What the gate makes of time stamps: rates, losses, pauses, clocks.
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "sample_gate_support.hpp"

namespace gyrod::stream {
namespace {

TEST_F(SampleGateTest, SeesRowsCutOutOfARecordingByRegularStamps) {
  feed(100);
  Sample sample = sample_at(100);
  sample.stamp_ns = 103 * kPeriodNs;
  const Verdict verdict = gate_.judge(sample);
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.bridge, 3U);
}

TEST_F(SampleGateTest, TrustsNumbersWhereAHostStampsInBursts) {
  // Five samples within 10 ms, then a pause of 40 ms: as a host reading a converter's queue stamps them.
  for (std::uint64_t n = 0; n < 500; ++n) {
    Sample sample = sample_at(n);
    sample.stamp_ns =
        static_cast<std::int64_t>(n / 5) * 50'000'000 + static_cast<std::int64_t>(n % 5) * 2'000'000;
    const Verdict verdict = gate_.judge(sample);
    ASSERT_EQ(verdict.kind, Kind::kAccept);
    ASSERT_EQ(verdict.bridge, 0U) << "sample " << n;
  }
  EXPECT_NEAR(gate_.rate_hz(), 100.0, 5.0)
      << "the mean of 64 intervals, which cover 13 bursts give or take one";
}

TEST_F(SampleGateTest, ClosesTheWindowAtALongPauseEvenWithoutAKnownPeriod) {
  feed(3);
  Sample sample = sample_at(3);
  sample.stamp_ns = 5'000'000'000;
  EXPECT_EQ(gate_.judge(sample).kind, Kind::kGap);
}

TEST_F(SampleGateTest, WorksByStampsWhereSamplesHaveNoNumbers) {
  for (std::uint64_t n = 0; n < 100; ++n) {
    Sample sample = sample_at(n);
    sample.sequence = 0;
    ASSERT_EQ(gate_.judge(sample).kind, Kind::kAccept);
  }
  Sample sample = sample_at(102);
  sample.sequence = 0;
  EXPECT_EQ(gate_.judge(sample).bridge, 2U);
  expect_refused(sample, RejectReason::kDuplicate);
}

TEST_F(SampleGateTest, NoticesAChangeOfTheSampleRate) {
  feed(200);
  EXPECT_NEAR(gate_.rate_hz(), 100.0, 1e-9);
  for (std::uint64_t n = 0; n < 200; ++n) {
    Sample sample = sample_at(200 + n);
    sample.stamp_ns = 200 * kPeriodNs + static_cast<std::int64_t>(n) * 2 * kPeriodNs;
    static_cast<void>(gate_.judge(sample));
  }
  EXPECT_NEAR(gate_.rate_hz(), 50.0, 1e-9);
  Sample sample = sample_at(400);
  sample.stamp_ns = 600 * kPeriodNs;
  EXPECT_EQ(gate_.judge(sample).bridge, 0U) << "the new period is the rule now";
}

TEST_F(SampleGateTest, SurvivesStampsAtTheEndsOfTheClock) {
  Sample sample = sample_at(1);
  sample.stamp_ns = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(gate_.judge(sample).kind, Kind::kAccept);
  sample.sequence = 2;
  sample.stamp_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(gate_.judge(sample).kind, Kind::kRestart);
}

TEST_F(SampleGateTest, TakesALateStampForWhatItIs) {
  feed(200);
  Sample late = sample_at(200);
  late.stamp_ns += 6 * kPeriodNs / 10;
  const Verdict verdict = gate_.judge(late);
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.missing, 0U) << "nothing is missing from the numbers, and no whole period has passed";
  EXPECT_EQ(gate_.judge(sample_at(201)).missing, 0U);
}

// The median of such intervals is a whole number of milliseconds: 125 Hz for 120, 250 for 225.
TEST(SampleGate, ReadsTheRateFromStampsInWholeMilliseconds) {
  for (const double rate_hz : {99.0, 104.0, 119.0, 120.0, 208.0, 225.0, 286.0, 400.0}) {
    SampleGate gate({.sample_rate_hz = 0.0, .max_rate_radps = 175.0, .max_bridged_samples = 16});
    for (std::uint64_t n = 0; n < 1000; ++n) {
      Sample sample = sample_at(n);
      sample.stamp_ns = std::llround(1e3 * static_cast<double>(n) / rate_hz) * 1'000'000;
      ASSERT_EQ(gate.judge(sample).bridge, 0U) << rate_hz << " Hz, sample " << n;
      // The stamps of 64 intervals' ends are half a millisecond off at most.
      if (n < 64) continue;
      ASSERT_NEAR(gate.rate_hz(), rate_hz, rate_hz * rate_hz / 64.0 * 1.001e-3) << n;
    }
  }
}

// A host that reads one tick late stamps nearly a whole period late, and the next sample right behind: nothing is missing.
TEST_F(SampleGateTest, TakesStampsThatAreOftenAPeriodLateForNoLoss) {
  std::uint64_t missing = 0;
  for (std::uint64_t n = 0; n < 5000; ++n) {
    Sample sample = sample_at(n);
    if (n % 50 == 49) sample.stamp_ns += kPeriodNs - 100'000;
    const Verdict verdict = gate_.judge(sample);
    ASSERT_EQ(verdict.kind, Kind::kAccept);
    missing += verdict.missing + verdict.bridge;
  }
  EXPECT_EQ(missing, 0U);
  EXPECT_NEAR(gate_.rate_hz(), 100.0, 0.1);
}

TEST_F(SampleGateTest, TakesAClockThatIsSetForANewBeginning) {
  feed(200);
  Sample sample = sample_at(200);
  sample.stamp_ns += 1'700'000'000'000'000'000;
  const Verdict verdict = gate_.judge(sample);
  EXPECT_EQ(verdict.kind, Kind::kRestart);
  EXPECT_EQ(verdict.missing, 0U);
  sample.sequence = 201;
  sample.stamp_ns = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(gate_.judge(sample).kind, Kind::kRestart);
}

TEST_F(SampleGateTest, TakesNoLossFromAClockThatIsSetAnHourAheadWhereNoNumberIsLeftOut) {
  feed(100);
  Sample sample = sample_at(100);
  sample.stamp_ns += 3'600'000'000'000;
  const Verdict verdict = gate_.judge(sample);
  EXPECT_EQ(verdict.kind, Kind::kRestart);
  EXPECT_EQ(verdict.missing, 0U);
  Sample next = sample_at(101);
  next.stamp_ns += 3'600'000'000'000;
  EXPECT_EQ(gate_.judge(next).kind, Kind::kAccept);
}

TEST(SlowSensor, IsNotAPauseAfterEverySample) {
  SampleGate gate({.sample_rate_hz = 0.5, .max_rate_radps = 175.0, .max_bridged_samples = 16});
  for (std::int64_t n = 0; n < 100; ++n) {
    const Verdict verdict = gate.judge({static_cast<std::uint64_t>(n), n * 2'000'000'000, {}});
    EXPECT_EQ(verdict.kind, Kind::kAccept);
    EXPECT_EQ(verdict.missing, 0U);
  }
}

}  // namespace
}  // namespace gyrod::stream
