// What the learner of rest remembers, for how long, and what it takes to change its mind: the numbers of docs/noise.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

#include "core/noise/standstill_learner.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

using testing::Axes;
using testing::kRadPerDeg;

/// Rest of so many seconds at 100 Hz, turning by so much about z. @return seconds of it that were taken for rest
double stand(StandstillLearner& learner, double seconds, double noise_dps, unsigned seed,
             double turn_dps = 0.0) {
  Axes axes = testing::still_axes(static_cast<std::size_t>(100.0 * seconds), noise_dps, seed);
  testing::add_rate(axes, 2, turn_dps);
  double believed = 0.0;
  testing::run(learner, axes, [&] { believed += learner.at_rest() ? 0.01 : 0.0; });
  return believed;
}

/// Mean variance of the three axes, in parts of this level's.
double variance_in(const StandstillLearner& learner, double noise_dps) {
  double sum = 0.0;
  for (const NoiseModel& model : learner.models()) sum += noise_variance(model) / 3.0;
  return sum / std::pow(noise_dps * kRadPerDeg, 2);
}

/// deg/s
double bias_z(const StandstillLearner& learner) { return learner.bias()[2] / kRadPerDeg; }

// A memory of ten minutes, full: after as long at 1.25 times the variance, e^-1 of the old is left, which is 1.158 (an average of all: 1.125). The level of
// three axes has a standard error of 0.4 % in variance.
TEST(StandstillMemory, IsTenMinutes) {
  StandstillLearner learner(100.0);
  stand(learner, 620.0, 0.3, 1);
  stand(learner, 600.0, 0.3 * std::sqrt(1.25), 2);
  EXPECT_NEAR(variance_in(learner, 0.3), 1.25 - 0.25 * std::exp(-1.0), 0.013);
}

// Windows of eight blocks of one level vary by 5 %; a run of blocks joins both levels, and needs five of the louder blocks for 1.5.
TEST(StandstillMemory, OneLevelVariesByHalfAtTheMost) {
  for (const double ratio : {1.3, 1.8}) {
    StandstillLearner learner(100.0);
    stand(learner, 120.0, 0.3, 3);
    const double believed = stand(learner, 60.0, 0.3 * std::sqrt(ratio), 4);
    EXPECT_GE(believed, ratio < 1.5 ? 50.0 : 0.0) << ratio;
    EXPECT_LE(believed, ratio < 1.5 ? 60.0 : 6.0) << ratio;
  }
}

/// Rest with a line of half a deviation at so many cycles per sample on z.
void stand_with_line(StandstillLearner& learner, double seconds, double cycles, unsigned seed) {
  Axes axes = testing::still_axes(static_cast<std::size_t>(100.0 * seconds), 0.3, seed);
  testing::add_tone(axes, 2, 0.15, cycles);
  testing::run(learner, axes, [] {});
}

// A restart, and then more rest with the same line: it neither fades nor broadens.
TEST(StandstillMemory, KeepsALineAcrossRestarts) {
  const double power = 0.125 * std::pow(0.3 * kRadPerDeg, 2);
  StandstillState state;
  for (unsigned run = 0; run < 6; ++run) {
    StandstillLearner learner(100.0);
    if (run > 0) {
      ASSERT_TRUE(learner.restore(state));
    }
    stand_with_line(learner, 60.0, 0.22, 20 + run);
    state = learner.state();
    const NoiseModel& noise = learner.models()[2];
    ASSERT_EQ(noise.line_count, 1U) << run;
    EXPECT_NEAR(noise.line[0].cycles, 0.22, 0.2 / static_cast<double>(kNoiseSegment)) << run;
    EXPECT_NEAR(noise.line[0].variance, power, 0.15 * power) << run;
    EXPECT_LT(noise.line[0].half_width, 0.3 / static_cast<double>(kNoiseSegment)) << run;
    EXPECT_EQ(learner.models()[0].line_count, 0U) << run;
  }
}

// Half an hour without a quiet rest in between, not in all.
TEST(StandstillMemory, AQuietRestBeginsTheHalfHourOfALouderOneAnew) {
  StandstillLearner learner(100.0);
  stand(learner, 60.0, 0.2, 5);
  stand(learner, 1000.0, 0.4, 6);
  stand(learner, 60.0, 0.2, 7);
  stand(learner, 1000.0, 0.4, 8);
  EXPECT_NEAR(variance_in(learner, 0.2), 1.0, 0.05);
}

// Ten seconds of what is learned, and five segments of half 512 samples, whichever is more: 12.8 s at 100 Hz. One block brings 1 s, or one segment.
TEST(StandstillMemory, HasItsFirstModelsAfterTenSecondsAndFiveSegments) {
  for (const double rate_hz : {100.0, 1000.0}) {
    StandstillLearner learner(rate_hz);
    const auto axes = testing::still_axes(static_cast<std::size_t>(40.0 * rate_hz), 0.35, 9);
    double first_s = 0.0;
    testing::run(learner, axes, [&] {
      if (first_s == 0.0 && learner.revision() > 0) first_s = learner.rest_seconds();
    });
    const double segment_s = 256.0 / rate_hz;
    EXPECT_GE(first_s, std::max(10.0, 5.0 * segment_s) - 1e-9) << rate_hz;
    EXPECT_LE(first_s, std::max(10.0, 5.0 * segment_s) + std::max(1.0, segment_s) + segment_s) << rate_hz;
  }
}

// A tenth more, and the models are made anew; a segment of 2.56 s is the least that comes.
TEST(StandstillMemory, ItsModelsAreNeverOlderThanATenthOfIt) {
  StandstillLearner learner(100.0);
  std::uint64_t revision = 0;
  double made_s = 0.0;
  std::size_t made = 0;
  testing::run(learner, testing::still_axes(30'000, 0.35, 10), [&] {
    const double now_s = learner.rest_seconds();
    if (learner.revision() != revision) {
      EXPECT_GE(now_s - made_s, 0.1 * now_s - 1e-9);
      revision = learner.revision();
      made_s = now_s;
      ++made;
    } else if (revision > 0) {
      EXPECT_LT(now_s - made_s, 0.1 * now_s);
    }
  });
  EXPECT_GT(made, 20U) << "ln(300 / 12.8) / ln(1 / 0.9) = 30, less as segments come whole";
}

// Who uses the models asks for the revision only; that there are none any more is a change, too.
TEST(StandstillMemory, NoModelChangesWithoutARevision) {
  StandstillLearner learner(100.0);
  std::array<NoiseModel, 3> models = learner.models();
  std::uint64_t revision = 0;
  bool forgot = false;
  const auto look = [&] {
    if (learner.models() == models) return;
    EXPECT_NE(learner.revision(), revision);
    models = learner.models();
    revision = learner.revision();
    forgot = forgot || models == std::array<NoiseModel, 3>{};
  };
  testing::run(learner, testing::still_axes(6000, 0.3, 11), look);
  testing::run(learner, testing::still_axes(6000, 0.2, 12), look);
  EXPECT_TRUE(forgot) << "quieter: what was learned was no rest";
}

// Thirteen seconds of each turn of twenty look like rest, and speak for another bias; each rest takes as much back.
TEST(StandstillMemory, TurnsBetweenRestsDoNotAddUpAgainstTheBias) {
  StandstillLearner learner(100.0);
  stand(learner, 620.0, 0.35, 13);
  for (unsigned i = 0; i < 60; ++i) {
    stand(learner, 20.0, 0.35, 100 + 2 * i, 3.0);
    stand(learner, 20.0, 0.35, 101 + 2 * i);
    ASSERT_NEAR(bias_z(learner), 1.0, 0.05) << i;
  }
}

TEST(StandstillMemory, TurnsToBothSidesDoNotAddUpAgainstTheBias) {
  StandstillLearner learner(100.0);
  stand(learner, 30.0, 0.35, 14);
  for (unsigned i = 0; i < 8; ++i) {
    stand(learner, 20.0, 0.35, 300 + i, i % 2 == 0 ? 3.0 : -3.0);
    EXPECT_NEAR(bias_z(learner), 1.0, 0.1) << i;
  }
}

// A state says that its bias was learned for years: it is still outvoted by more than the ten minutes that count.
TEST(StandstillMemory, ABiasThatIsRestoredCountsForNoMoreThanTheMemory) {
  StandstillLearner source(100.0);
  stand(source, 60.0, 0.35, 15);
  StandstillState state = source.state();
  state.bias_seconds = 1e8;
  StandstillLearner learner(100.0);
  ASSERT_TRUE(learner.restore(state));
  stand(learner, 560.0, 0.35, 16, 3.0);
  EXPECT_NEAR(bias_z(learner), 1.0, 0.05);
  stand(learner, 100.0, 0.35, 17, 3.0);
  EXPECT_NEAR(bias_z(learner), 4.0, 0.05);
}

}  // namespace
}  // namespace gyrod::core
