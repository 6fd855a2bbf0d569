#include "stream/sample_gate.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/samples.hpp"

namespace gyrod::stream {
namespace {

using testing::kPeriodNs;
using testing::sample_at;
using Kind = Verdict::Kind;

class SampleGateTest : public ::testing::Test {
 protected:
  void feed(std::uint64_t count, std::uint64_t first = 0) {
    for (std::uint64_t n = first; n < first + count; ++n)
      ASSERT_EQ(gate_.judge(sample_at(n)).kind, Kind::kAccept);
  }
  void expect_refused(const Sample& sample, RejectReason reason) {
    const Verdict verdict = gate_.judge(sample);
    EXPECT_EQ(verdict.kind, Kind::kRefuse);
    EXPECT_EQ(verdict.reason, reason);
  }
  SampleGate gate_{{.sample_rate_hz = 0.0, .max_rate_radps = 175.0, .max_bridged_samples = 16}};
};

TEST_F(SampleGateTest, RefusesValuesThatAreNotFinite) {
  Sample sample = sample_at(0);
  sample.rate_radps[2] = std::nan("");
  expect_refused(sample, RejectReason::kNotFinite);
  sample.rate_radps[2] = -std::numeric_limits<double>::infinity();
  expect_refused(sample, RejectReason::kNotFinite);
}

TEST_F(SampleGateTest, RefusesRatesBeyondTheRangeButNotAtIt) {
  expect_refused(sample_at(0, 1e300), RejectReason::kOutOfRange);
  expect_refused(sample_at(0, -175.1), RejectReason::kOutOfRange);
  EXPECT_EQ(gate_.judge(sample_at(0, 175.0)).kind, Kind::kAccept);
}

TEST_F(SampleGateTest, TellsADuplicateFromALateSample) {
  feed(5);
  EXPECT_EQ(gate_.judge(sample_at(7)).kind, Kind::kAccept);
  expect_refused(sample_at(7), RejectReason::kDuplicate);
  expect_refused(sample_at(3), RejectReason::kDuplicate);
  expect_refused(sample_at(6), RejectReason::kOutOfOrder);
}

TEST_F(SampleGateTest, TakesWhatIsOlderByFarForARestartOnceOneIsExpectedAndNoLateSample) {
  feed(200);
  gate_.expect_restart();
  EXPECT_EQ(gate_.judge(sample_at(202)).kind, Kind::kAccept);
  expect_refused(sample_at(0), RejectReason::kOutOfOrder);  // no longer expected: a sample came as it should
  gate_.expect_restart();
  expect_refused(sample_at(201), RejectReason::kOutOfOrder);
  expect_refused(sample_at(202), RejectReason::kDuplicate);
  EXPECT_EQ(gate_.judge(sample_at(0)).kind, Kind::kRestart);
  EXPECT_EQ(gate_.judge(sample_at(1)).kind, Kind::kAccept);
}

TEST(SampleGate, MissesNothingBeforeItsFirstSampleAlsoAtAConfiguredRate) {
  SampleGate gate({.sample_rate_hz = 100.0, .max_rate_radps = 175.0, .max_bridged_samples = 16});
  EXPECT_EQ(gate.judge(sample_at(300)).missing, 0U);
}

TEST_F(SampleGateTest, CountsWhatIsMissingBehindAnEndWhereNumbersAndStampsGoOn) {
  feed(200);
  gate_.reopen();
  Verdict verdict = gate_.judge(sample_at(300));
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.missing, 100U);
  EXPECT_EQ(verdict.bridge, 0U) << "a new window begins";
  gate_.reopen();
  Sample elsewhere = sample_at(1000);
  elsewhere.stamp_ns = sample_at(310).stamp_ns;  // 700 numbers in 10 periods: another numbering
  verdict = gate_.judge(elsewhere);
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.missing, 0U);
  gate_.reopen();
  EXPECT_EQ(gate_.judge(sample_at(0)).missing, 0U);
}

TEST_F(SampleGateTest, RefusesAStampThatGoesBackOrStands) {
  feed(5);
  Sample sample = sample_at(5);
  sample.stamp_ns = 4 * kPeriodNs;
  expect_refused(sample, RejectReason::kTimeBackwards);
  sample.stamp_ns = 0;
  expect_refused(sample, RejectReason::kTimeBackwards);
  EXPECT_EQ(gate_.judge(sample_at(5)).kind, Kind::kAccept) << "the good sample of that number still comes";
}

TEST_F(SampleGateTest, BridgesAShortLossByNumber) {
  feed(100);
  const Verdict verdict = gate_.judge(sample_at(103));
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.bridge, 3U);
  EXPECT_EQ(verdict.missing, 3U);
}

TEST_F(SampleGateTest, ClosesTheWindowAtALongLoss) {
  feed(100);
  const Verdict verdict = gate_.judge(sample_at(117));
  EXPECT_EQ(verdict.kind, Kind::kGap);
  EXPECT_EQ(verdict.missing, 17U);
}

TEST_F(SampleGateTest, BridgesTheLongestAllowedLoss) {
  feed(100);
  EXPECT_EQ(gate_.judge(sample_at(116)).bridge, 16U);
}

TEST_F(SampleGateTest, SeesRowsCutOutOfARecordingByRegularStamps) {
  feed(100);
  Sample sample = sample_at(100);
  sample.stamp_ns = 103 * kPeriodNs;
  const Verdict verdict = gate_.judge(sample);
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.bridge, 3U);
}

TEST_F(SampleGateTest, DoesNotCountARefusedSampleAsMissing) {
  feed(10);
  expect_refused(sample_at(10, std::nan("")), RejectReason::kNotFinite);
  const Verdict verdict = gate_.judge(sample_at(11));
  EXPECT_EQ(verdict.bridge, 1U);
  EXPECT_EQ(verdict.missing, 0U);
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

TEST_F(SampleGateTest, TakesARebootedSensorAfterEightSamplesThatAgree) {
  feed(1000, 5000);
  for (std::uint64_t n = 0; n < 7; ++n) {
    Sample sample = sample_at(n);
    sample.stamp_ns += 7000 * kPeriodNs;
    expect_refused(sample, RejectReason::kOutOfOrder);
  }
  Sample sample = sample_at(7);
  sample.stamp_ns += 7000 * kPeriodNs;
  EXPECT_EQ(gate_.judge(sample).kind, Kind::kRestart);
}

TEST_F(SampleGateTest, TakesASteppedBackClockAfterEightSamplesThatAgree) {
  feed(500, 1000);
  int refused = 0;
  Verdict verdict;
  for (std::uint64_t n = 1500; n < 1510 && verdict.kind != Kind::kRestart; ++n) {
    Sample sample = sample_at(n);
    sample.stamp_ns -= 3'600'000'000'000;
    verdict = gate_.judge(sample);
    refused += verdict.kind == Kind::kRefuse ? 1 : 0;
  }
  EXPECT_EQ(refused, SampleGate::kAnew - 1);
  EXPECT_EQ(verdict.kind, Kind::kRestart);
}

TEST_F(SampleGateTest, DoesNotRestartForASecondPublisherInterleaved) {
  feed(100, 1000);
  for (std::uint64_t n = 0; n < 50; ++n) {
    Sample other = sample_at(n);
    other.stamp_ns += 1100 * kPeriodNs;
    EXPECT_EQ(gate_.judge(other).kind, Kind::kRefuse);
    EXPECT_EQ(gate_.judge(sample_at(1100 + n)).kind, Kind::kAccept);
  }
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

TEST_F(SampleGateTest, BridgesARefusedSampleWithoutANumberAsOneWithANumber) {
  // Irregular stamps, by which alone nothing would show.
  const auto at = [](std::int64_t stamp_ms, double x) {
    return Sample{0, stamp_ms * 1'000'000, {x, 0.0, 0.0}};
  };
  for (const std::int64_t stamp_ms : {1, 2, 30, 31, 60})
    ASSERT_EQ(gate_.judge(at(stamp_ms, 0.0)).kind, Kind::kAccept);
  expect_refused(at(61, std::nan("")), RejectReason::kNotFinite);
  expect_refused(at(60, std::nan("")),
                 RejectReason::kNotFinite);  // came twice: stands for no sample of its own
  const Verdict verdict = gate_.judge(at(90, 0.0));
  EXPECT_EQ(verdict.kind, Kind::kAccept);
  EXPECT_EQ(verdict.bridge, 1U);
  EXPECT_EQ(verdict.missing, 0U);
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

TEST_F(SampleGateTest, RefusesARunThatIsSentTwiceHoweverLong) {
  feed(200);
  for (std::uint64_t n = 180; n < 200; ++n) expect_refused(sample_at(n), RejectReason::kDuplicate);
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
