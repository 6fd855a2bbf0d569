#include "core/noise/still_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

/// AR(2) with poles 0.8 e^(+-i pi/3), driven by variance 1, plus white noise of variance 2.
NoiseModel truth() {
  NoiseModel model = white_noise(2.0);
  model.colour_order = 2;
  model.colour = {0.8, -0.64};
  model.colour_variance = 1.0;
  return model;
}

Signal coloured(std::size_t size, unsigned seed) {
  const std::array<double, 2> a = {0.8, -0.64};
  return testing::sum(testing::autoregressive(a, size, seed), testing::white_noise(size, seed + 1000),
                      std::numbers::sqrt2);
}

double level(const NoiseModel& model) { return std::sqrt(noise_variance(model)); }

TEST(StillNoise, FindsTheLevelOfWhiteNoiseWithinItsStandardError) {
  // Tapered, half overlapping segments keep 0.96 of the information of N samples (Welch 1967): 1 / sqrt(2 * 0.96 N) of the
  // standard deviation. Twenty records of a minute at 100 Hz; four standard errors for each, and for their mean.
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto model = still_noise(testing::times(testing::white_noise(6000, seed), 0.01));
    ASSERT_TRUE(model.has_value());
    EXPECT_NEAR(level(*model), 0.01, 0.01 * 4.0 * 0.0093) << seed;
    sum += level(*model) / 20.0;
  }
  EXPECT_NEAR(sum, 0.01, 0.01 * 4.0 * 0.0093 / std::sqrt(20.0));
}

TEST(StillNoise, IsFlatWithinAFewPerCentForWhiteNoise) {
  // An AR(8) from N samples has a relative standard error of about sqrt(2 * 8 / N) = 1.6 % on average; five of them.
  const auto model = still_noise(testing::white_noise(60'000, 7));
  ASSERT_TRUE(model.has_value());
  for (double w = 0.05; w < std::numbers::pi; w += 0.05) EXPECT_NEAR(noise_spectrum(*model, w), 1.0, 0.08);
}

TEST(StillNoise, FindsTheSpectrumOfColouredNoise) {
  // An AR(2) plus white is an ARMA(2,2); eight coefficients and half the floor follow it to a few per cent.
  const auto model = still_noise(coloured(200'000, 11));
  ASSERT_TRUE(model.has_value());
  for (double w = 0.05; w < std::numbers::pi; w += 0.05) {
    EXPECT_NEAR(noise_spectrum(*model, w) / noise_spectrum(truth(), w), 1.0, 0.08) << w;
  }
  EXPECT_NEAR(noise_variance(*model), noise_variance(truth()), 0.02 * noise_variance(truth()));
}

TEST(StillNoise, IsScaledWithTheData) {
  const Signal noise = coloured(6000, 3);
  const auto one = still_noise(noise);
  const auto thousandth = still_noise(testing::times(noise, 1e-3));
  ASSERT_TRUE(one && thousandth);
  EXPECT_NEAR(noise_variance(*thousandth), 1e-6 * noise_variance(*one), 1e-15);
}

TEST(StillNoise, DoesNotSeeBiasNorSlowDrift) {
  const Signal noise = coloured(6000, 5);
  Signal drifting = noise;
  for (std::size_t n = 0; n < drifting.size(); ++n) {
    const double t = static_cast<double>(n);
    // A line of 12 and a swing of +-1 over the whole minute: a hundred times the noise at its own frequency.
    drifting[n] += 40.0 + 0.002 * t + std::sin(2.0 * std::numbers::pi * t / 6000.0);
  }
  const auto still = still_noise(noise);
  const auto moved = still_noise(drifting);
  ASSERT_TRUE(still && moved);
  // What of the swing is no line within 512 samples is below 1e-3 of the noise.
  EXPECT_NEAR(level(*moved), level(*still), 2e-3 * level(*still));
}

TEST(StillNoise, LeavesShocksOut) {
  const Signal noise = testing::white_noise(20'000, 9);
  Signal struck = noise;
  for (const std::size_t at : {std::size_t{3000}, std::size_t{11'700}}) {
    for (std::size_t n = 0; n < 20; ++n) struck[at + n] -= 40.0 * std::exp(-0.2 * static_cast<double>(n));
  }
  const auto clean = still_noise(noise);
  const auto found = still_noise(struck);
  ASSERT_TRUE(clean && found);
  // Four of 77 segments are gone: the level moves by its standard error of 0.5 % times sqrt(4 / 77), not by the shocks' 14 %.
  EXPECT_NEAR(level(*found), level(*clean), 0.01);
}

// A quarter of a recording twice as strong in variance, as of a fan next door: what is 1.5 times the median and more is left out. Of the segments at
// both ends, which hold half of it, some may stay: 2 of 78. With all of it the variance would be 1.25.
TEST(StillNoise, LeavesOutWhatIsTwiceAsStrong) {
  Signal noise = testing::white_noise(20'000, 9);
  for (std::size_t n = 9000; n < 14'000; ++n) noise[n] *= std::numbers::sqrt2;
  const auto found = still_noise(noise);
  ASSERT_TRUE(found);
  EXPECT_NEAR(noise_variance(*found), 1.0, 0.05);
}

TEST(StillNoise, ReadsThroughQuantisation) {
  // A converter of step q adds q^2/12 where the noise is larger than the step: 0.35 and 0.05, as an ADIS16405 has.
  const Signal noise = testing::times(testing::white_noise(60'000, 13), 0.35);
  const auto model = still_noise(testing::quantised(noise, 0.05));
  ASSERT_TRUE(model.has_value());
  EXPECT_NEAR(noise_variance(*model), 0.35 * 0.35 + 0.05 * 0.05 / 12.0, 4.0 * 0.0058 * 0.35 * 0.35);
}

TEST(StillNoise, IsUsableEvenBesideAStrongLine) {
  const Signal noise = testing::sum(testing::white_noise(20'000, 17), testing::tone(20'000, 0.2), 3.0);
  const auto model = still_noise(noise);
  ASSERT_TRUE(model.has_value());
  EXPECT_TRUE(is_usable(*model));
  // White 1 and tone 9/2.
  EXPECT_NEAR(noise_variance(*model), 5.5, 0.1);
}

TEST(StillNoise, SaysNothingOfTooFewOrConstantSamples) {
  EXPECT_FALSE(still_noise(testing::white_noise(kMinStillSamples - 1, 1)).has_value());
  EXPECT_TRUE(still_noise(testing::white_noise(kMinStillSamples, 1)).has_value());
  EXPECT_FALSE(still_noise(Signal(5000, 0.25)).has_value());
  EXPECT_FALSE(still_noise(Signal()).has_value());
}

}  // namespace
}  // namespace gyrod::core
