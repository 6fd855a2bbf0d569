#include "core/noise/noise_lines.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/noise/still_noise.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

/// Half an hour at 100 Hz.
constexpr std::size_t kRecord = 180'000;
constexpr double kManySegments = 700.0;

NoiseModel noise_of(const Signal& still) { return still_noise(still).value(); }

/// A sine of so many deviations of white noise of 1.
Signal sine(double amplitude, double cycles) {
  return testing::times(testing::tone(kRecord, cycles), amplitude);
}

// Of a sine a / 2 a squared. Frequency within a tenth of a bin; no width but what the taper makes of it.
TEST(NoiseLines, FindsASine) {
  for (const double cycles : {0.05, 0.2, 0.3313, 0.47}) {
    const NoiseModel noise = noise_of(testing::sum(testing::white_noise(kRecord, 1), sine(0.5, cycles), 1.0));
    ASSERT_EQ(noise.line_count, 1U) << cycles;
    EXPECT_NEAR(noise.line[0].cycles, cycles, 0.1 / kNoiseSegment) << cycles;
    EXPECT_NEAR(noise.line[0].variance, 0.125, 0.05 * 0.125) << cycles;
    EXPECT_LT(noise.line[0].half_width, 0.2 / kNoiseSegment) << cycles;
    EXPECT_NEAR(noise_variance(without_lines(noise)), 1.0, 0.02) << cycles;
  }
}

TEST(NoiseLines, FindsThreeLinesByFrequencyAndNoMore) {
  Signal still = testing::white_noise(kRecord, 2);
  for (const double cycles : {0.41, 0.1, 0.27}) still = testing::sum(still, sine(0.5, cycles), 1.0);
  NoiseModel noise = noise_of(still);
  ASSERT_EQ(noise.line_count, 3U);
  EXPECT_NEAR(noise.line[0].cycles, 0.1, 1e-3);
  EXPECT_NEAR(noise.line[1].cycles, 0.27, 1e-3);
  EXPECT_NEAR(noise.line[2].cycles, 0.41, 1e-3);
  // The strongest three; the fourth is part of the colour.
  noise = noise_of(testing::sum(still, sine(0.4, 0.18), 1.0));
  ASSERT_EQ(noise.line_count, 3U);
  EXPECT_NEAR(noise.line[1].cycles, 0.27, 1e-3);
  EXPECT_NEAR(noise_variance(noise), 1.0 + 3.0 * 0.125 + 0.08, 0.02);
}

// A resonance with poles of radius r is -ln r / (2 pi) cycles wide to either side at half its height.
TEST(NoiseLines, TellsHowWideALineIs) {
  for (const double radius : {0.99, 0.98, 0.97}) {
    const std::array<double, 2> a = {2.0 * radius * std::cos(0.5 * std::numbers::pi), -radius * radius};
    const Signal shape = testing::autoregressive(a, kRecord, 3);
    const double power = std::inner_product(shape.begin(), shape.end(), shape.begin(), 0.0) / kRecord;
    const NoiseModel noise = noise_of(
        testing::sum(testing::white_noise(kRecord, 4), testing::times(shape, 1.0 / std::sqrt(power)), 1.0));
    ASSERT_EQ(noise.line_count, 1U) << radius;
    const double half_width = -std::log(radius) / (2.0 * std::numbers::pi);
    EXPECT_NEAR(noise.line[0].cycles, 0.25, 1e-3) << radius;
    EXPECT_NEAR(noise.line[0].half_width, half_width, 0.25 * half_width) << radius;
    // What of its foot is below half of the floor counts to the rest: a quarter of the widest.
    EXPECT_NEAR(noise.line[0].variance, 0.85, 0.15) << radius;
    // The narrow one comes and goes: segments that are 1.5 times the median are left out.
    EXPECT_NEAR(noise_variance(noise), 2.0, 0.1) << radius;
  }
}

// The fewest segments that noise is learned from, six: by a height of 4 one in a hundred would have a line, and one in 250 no model at all when the last bin,
// which scatters most, was looked at, too.
TEST(NoiseLines, WhiteNoiseHasNone) {
  int found = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed)
    found += noise_of(testing::white_noise(kMinStillSamples, seed)).line_count > 0 ? 1 : 0;
  EXPECT_LE(found, 2);
}

TEST(NoiseLines, WhatIsAtHalfTheSampleRateIsNone) {
  NoiseSpectrum power{};
  power.fill(1.0);
  power[kNoiseBins - 1] = 50.0;
  const auto noise = fit_noise_and_lines(power, kManySegments);
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->line_count, 0U);
  for (const double cycles : {0.49, 0.498}) {
    const NoiseModel near = noise_of(testing::sum(testing::white_noise(kRecord, 8), sine(1.0, cycles), 1.0));
    ASSERT_EQ(near.line_count, 1U) << cycles;
    EXPECT_LT(near.line[0].cycles, 0.5) << cycles;
    EXPECT_NEAR(near.line[0].variance, 0.5, 0.05) << cycles;
    EXPECT_NEAR(noise_variance(near), 1.5, 0.05) << cycles;
  }
}

// A sine in the lowest bins is one line, and where it is too slow for one its skirt is none.
TEST(NoiseLines, AreWholeInTheLowestBins) {
  for (const double bin : {13.3, 14.0, 16.5}) {
    const NoiseModel noise =
        noise_of(testing::sum(testing::white_noise(kRecord, 9), sine(5.0, bin / kNoiseSegment), 1.0));
    ASSERT_EQ(noise.line_count, 1U) << bin;
    EXPECT_NEAR(noise.line[0].cycles * kNoiseSegment, bin, 0.1) << bin;
    EXPECT_NEAR(noise.line[0].variance, 12.5, 0.6) << bin;
  }
  for (const double bin : {11.2, 11.5, 12.0}) {
    EXPECT_EQ(noise_of(testing::sum(testing::white_noise(kRecord, 9), sine(1.5, bin / kNoiseSegment), 1.0))
                  .line_count,
              0U)
        << bin;
  }
}

// Filters need a white part.
TEST(NoiseLines, LeaveAWhitePartWhereTheyHaveNearlyAll) {
  const NoiseModel noise =
      noise_of(testing::sum(testing::times(testing::white_noise(kRecord, 10), 1e-4), sine(1.0, 0.2), 1.0));
  ASSERT_EQ(noise.line_count, 1U);
  EXPECT_GT(noise.white_variance, 0.9e-4 * noise_variance(noise));
}

TEST(NoiseLines, ASensorsOwnLowPassIsNoLineNorIsWhatIsSlow) {
  const std::array<double, 2> low_pass = {1.2, -0.5};
  EXPECT_EQ(noise_of(testing::autoregressive(low_pass, kRecord, 5)).line_count, 0U);
  EXPECT_EQ(noise_of(testing::sum(testing::white_noise(kRecord, 6), sine(1.0, 0.015), 1.0)).line_count, 0U);
  for (const double bins :
       {2.56, 5.12, 8.0, 30.0, 100.0}) {  // of second order, as of a filter at 10 Hz of 1000
    NoiseSpectrum power{};
    for (std::size_t k = 0; k < kNoiseBins; ++k)
      power[k] = 1.0 / (1.0 + std::pow(static_cast<double>(k) / bins, 4.0)) + 3e-4;
    EXPECT_EQ(take_lines(power, kManySegments).line_count, 0U) << bins;
  }
}

// In segments of 512 samples a sine stands 171 times its power above white noise of 1, 3 from 1.8 % on: amplitudes of 0.17 and 0.21 are 1.4 and 2.2 %.
TEST(NoiseLines, StandFourTimesAsHighAsTheFloor) {
  const auto lines_of = [](double amplitude) {
    return noise_of(
               testing::sum(testing::white_noise(kRecord, 7), sine(amplitude, 102.0 / kNoiseSegment), 1.0))
        .line_count;
  };
  EXPECT_EQ(lines_of(0.17), 0U);
  EXPECT_EQ(lines_of(0.21), 1U);
}

// What a model remembers of its lines is found in it again, as after a restart.
TEST(NoiseLines, ComeBackFromTheirModel) {
  NoiseModel model = white_noise(1.0);
  model.line_count = 2;
  model.line[0] = {.cycles = 0.12, .half_width = 0.0004, .variance = 0.2};
  model.line[1] = {.cycles = 0.33, .half_width = 0.003, .variance = 0.6};
  NoiseSpectrum power{};
  power.fill(1.0);
  add_lines(model, power);
  const SpectrumParts parts = take_lines(power, kManySegments);
  ASSERT_EQ(parts.line_count, 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(parts.line[i].cycles, model.line[i].cycles, 0.1 / kNoiseSegment) << i;
    EXPECT_NEAR(parts.line[i].variance, model.line[i].variance, 0.03 * model.line[i].variance) << i;
    EXPECT_NEAR(parts.line[i].half_width, model.line[i].half_width, 0.15 / kNoiseSegment) << i;
  }
  for (std::size_t k = 0; k < kNoiseBins; ++k) EXPECT_LE(parts.rest[k], 1.5 + 1e-9) << k;
}

TEST(NoiseLines, NothingIsTakenFromNothing) {
  EXPECT_EQ(take_lines(NoiseSpectrum{}, kManySegments).line_count, 0U);
  EXPECT_FALSE(fit_noise_and_lines(NoiseSpectrum{}, kManySegments));
  NoiseSpectrum broken{};
  broken.fill(1.0);
  broken[100] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(fit_noise_and_lines(broken, kManySegments));
}

}  // namespace
}  // namespace gyrod::core
