// What the gate takes and refuses, and losses by number.
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "sample_gate_support.hpp"

namespace gyrod::stream {
namespace {

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

TEST_F(SampleGateTest, DoesNotCountARefusedSampleAsMissing) {
  feed(10);
  expect_refused(sample_at(10, std::nan("")), RejectReason::kNotFinite);
  const Verdict verdict = gate_.judge(sample_at(11));
  EXPECT_EQ(verdict.bridge, 1U);
  EXPECT_EQ(verdict.missing, 0U);
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

TEST_F(SampleGateTest, RefusesARunThatIsSentTwiceHoweverLong) {
  feed(200);
  for (std::uint64_t n = 180; n < 200; ++n) expect_refused(sample_at(n), RejectReason::kDuplicate);
}

}  // namespace
}  // namespace gyrod::stream
