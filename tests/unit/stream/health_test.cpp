// States that single samples and counts tell: entry and exit at the exact sample or second. Stamps are the test's own: no clock.
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "health_support.hpp"

namespace gyrod::stream {
namespace {

TEST_F(SensorHealthTest, IsOkWhereNothingSpeaksAgainstIt) {
  for (int second = 0; second < 200; ++second) {
    send_s(1.0);
    EXPECT_EQ(state(), Health::kOk) << second;
  }
}

TEST_F(SensorHealthTest, WarmsUpUntilTheWindowIsFull) {
  watch_.begin_stretch();
  send(kWindow - 1);
  const SensorHealth warming = judge();
  EXPECT_EQ(warming.state, Health::kWarmingUp);
  EXPECT_EQ(warming.axis[2].value, 63.0);
  EXPECT_EQ(warming.axis[2].limit, 64.0);
  send(1);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(SensorHealthTest, IsSilentAfterMoreThanASecondAndOverWithTheNextSample) {
  now_s_ += 1.0;
  EXPECT_EQ(state(), Health::kOk);
  now_s_ += 0.01;
  EXPECT_EQ(state(), Health::kSilent);
  EXPECT_NEAR(judge().axis[0].value, 1.01, 1e-9);
  watch_.hear(now_s_, kHz);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(SensorHealthTest, ASlowSensorMayBeQuietForTenPeriods) {
  watch_.hear(now_s_, 2.0);
  now_s_ += 5.0;
  EXPECT_EQ(state(), Health::kOk);
  now_s_ += 0.01;
  EXPECT_EQ(state(), Health::kSilent);
}

TEST_F(SensorHealthTest, ASensorWhoseWriterHasGoneIsSilentAtOnce) {
  watch_.end();
  EXPECT_EQ(state(), Health::kSilent);
  watch_.hear(now_s_, kHz);
  EXPECT_EQ(state(), Health::kOk);
}

// While gyrod waits for its workers it takes no samples: that is not the sensor's silence.
TEST_F(SensorHealthTest, SilenceCountsFromWhenGyrodListensAgain) {
  now_s_ += 30.0;
  deaf_until_s_ = now_s_ - 0.5;
  EXPECT_EQ(state(), Health::kOk);
  now_s_ += 0.6;
  EXPECT_EQ(state(), Health::kSilent);
}

TEST_F(SensorHealthTest, AnAxisIsStuckAfterASecondOfOneValueWhileAnotherMoves) {
  const auto stuck_y = [](std::uint64_t n) {
    auto rates = moving(n);
    rates[1] = 0.25;
    return rates;
  };
  send(100, stuck_y);  // 0.99 s from the first to the last
  EXPECT_EQ(state(), Health::kOk);
  send(1, stuck_y);
  const SensorHealth stuck = judge();
  EXPECT_EQ(stuck.state, Health::kStuck);
  EXPECT_EQ(stuck.axis[0].state, Health::kOk);
  EXPECT_EQ(stuck.axis[1].state, Health::kStuck);
  EXPECT_DOUBLE_EQ(stuck.axis[1].value, 1.0);
  send(1);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(SensorHealthTest, AllAxesAreStuckAfterTenSeconds) {
  const auto frozen = [](std::uint64_t) { return std::array<double, kAxes>{0.1, 0.2, 0.3}; };
  send(1000, frozen);
  EXPECT_EQ(state(), Health::kOk) << "9.99 s: a coarse converter at rest";
  send(1, frozen);
  EXPECT_EQ(judge().axis[2].state, Health::kStuck);
}

TEST_F(SensorHealthTest, AValueAcrossABreakIsNotTheSame) {
  const auto frozen = [](std::uint64_t) { return std::array<double, kAxes>{0.1, 0.2, 0.3}; };
  send(900, frozen);
  watch_.begin_stretch();
  send(900, frozen);
  EXPECT_EQ(state(), Health::kOk);
}

TEST(Saturation, TakesThreeSamplesInAWindowAtTheConfiguredRangeAndHoldsForTenSeconds) {
  HealthOptions options;
  options.range_radps = 4.36;  // 250 deg/s
  HealthWatch watch(options, kWindow);
  HealthJudge judge(options, kWindow);
  std::uint64_t n = 0;
  const auto send = [&](double x) {
    Sample sample{.sequence = n, .stamp_ns = static_cast<std::int64_t>(n) * 10'000'000};
    const double odd = n++ % 2 == 0 ? 0.01 : -0.01;
    sample.rate_radps = {x == 0.0 ? odd : x, odd, odd};
    watch.step(sample, true);
    watch.hear(0.0, kHz);
    return judge.judge(watch.evidence(), {}).axis[0].state;
  };
  for (std::size_t i = 0; i < kWindow; ++i) send(0.0);
  EXPECT_EQ(send(4.36), Health::kOk);
  for (int i = 0; i < 31; ++i) send(0.0);
  EXPECT_EQ(send(-4.37), Health::kOk);
  for (int i = 0; i < 31; ++i) send(0.0);
  EXPECT_EQ(send(4.36), Health::kOk) << "64 samples from the first to the third are more than a window";
  for (int i = 0; i < 30; ++i) send(0.0);
  EXPECT_EQ(send(4.36), Health::kSaturated) << "63 are not";
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(send(0.0), Health::kSaturated) << i;
  EXPECT_EQ(send(0.0), Health::kOk) << "more than 10 s without";
}

TEST_F(SensorHealthTest, LearnsItsLimitFromTwoVisitsAndUnlearnsItWhereItWasNone) {
  const auto peak = [](double top) {
    return [top](std::uint64_t n) {
      auto rates = moving(n);
      rates[2] =
          std::min(top, 0.2 * static_cast<double>(n % 20) + rates[2]);  // flat for some samples of twenty
      return rates;
    };
  };
  send(20 - n_ % 20);
  send(20, peak(2.0));
  EXPECT_EQ(state(), Health::kOk) << "flat once: chance";
  send(40, peak(2.0));
  EXPECT_EQ(judge().axis[2].state, Health::kSaturated);
  send_s(10.1);
  EXPECT_EQ(state(), Health::kOk);
  send(20, peak(3.0));  // so 2 was not the limit
  send_s(0.1);
  EXPECT_EQ(state(), Health::kOk);
}

// At rest a coarse converter gives its largest value often, and several times in a row.
TEST_F(SensorHealthTest, ACoarseConverterAtRestIsNotSaturated) {
  send(2000, [](std::uint64_t n) {
    const double step = static_cast<double>(n / 4 % 3) - 1.0;
    return std::array<double, kAxes>{0.01 * step, -0.01 * step, 0.02 * step};
  });
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(SensorHealthTest, IsLossyAboveOnePerCentOfAMinuteAndUntilBelowHalf) {
  for (int second = 0; second < 120; ++second) {
    send_s(1.0);
    if (second % 2 == 0) watch_.lose(2);
    EXPECT_EQ(state(), Health::kOk) << "2 of 202 are 0.99 %, second " << second;
  }
  int seconds = 0;
  for (; state() == Health::kOk && seconds < 60; ++seconds) {
    send_s(1.0);
    watch_.lose(2);
  }
  // 60 s of 1 a second hold 60; two more replace one and a half each time: the 61st of 6061 comes within three seconds.
  EXPECT_LE(seconds, 3);
  EXPECT_EQ(judge().axis[1].state, Health::kLossy) << "of all axes";
  for (seconds = 0; state() == Health::kLossy && seconds < 120; ++seconds) send_s(1.0);
  // Some 62 of 6060 lost, one a second falls out: below 0.5 % when half of them are out.
  EXPECT_NEAR(seconds, 32, 3);
}

TEST_F(SensorHealthTest, AFewLostAfterTheStartAreNoShare) {
  judge();
  send(10);
  watch_.lose(4);
  now_s_ += 0.5;
  EXPECT_EQ(state(), Health::kOk);
  watch_.lose(1);
  EXPECT_EQ(state(), Health::kLossy);
}

TEST_F(SensorHealthTest, IsDegradedWhileGyrodIsOverloaded) {
  EXPECT_EQ(judge(1).state, Health::kDegraded);
  EXPECT_EQ(judge(2).axis[0].value, 2.0);
  EXPECT_EQ(judge(0).state, Health::kOk);
}

}  // namespace
}  // namespace gyrod::stream
