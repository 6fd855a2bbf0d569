#include "core/noise/noise_units.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

/// AR(1) of pole 0.5 driven by variance 3, and white noise of 1: variance 5, 13 at frequency 0, covariance 0.5 * 4 at lag 1.
NoiseModel coloured() {
  NoiseModel model = white_noise(1.0);
  model.colour_order = 1;
  model.colour[0] = 0.5;
  model.colour_variance = 3.0;
  return model;
}

TEST(NoiseUnits, AreThoseOfADataSheetThatGivesBoth) {
  // ADIS16405, +-300 deg/s: 0.05 deg/s/sqrt(Hz) rms and 2.0 deg/sqrt(h). At 100 Hz: 0.05 sqrt(50) = 0.354 and 2 / 60 sqrt(100) = 0.333;
  // still recordings of it have 0.35.
  EXPECT_NEAR(std::sqrt(noise_variance(from_noise_density(0.05, 100.0))), 0.35355, 1e-5);
  EXPECT_NEAR(std::sqrt(noise_variance(from_angle_random_walk(2.0 / 60.0, 100.0))), 0.33333, 1e-5);
}

TEST(NoiseUnits, GoBothWays) {
  EXPECT_NEAR(noise_density(from_noise_density(0.05, 100.0), 100.0), 0.05, 1e-15);
  EXPECT_NEAR(angle_random_walk(from_angle_random_walk(0.03, 200.0), 200.0), 0.03, 1e-15);
}

TEST(NoiseUnits, TakeTheRandomWalkFromTheSlowEnd) {
  EXPECT_NEAR(angle_random_walk(coloured(), 100.0), std::sqrt(0.13), 1e-12);
  EXPECT_NEAR(noise_density(coloured(), 100.0), std::sqrt(0.10), 1e-12);
}

// Half the power at the bandwidth, 1/17 at twice of it; the density where it passes, and over all what a filter of second order lets
// through, pi / (2 sqrt(2)) of the bandwidth.
TEST(NoiseUnits, FallBehindALowPass) {
  const NoiseModel white = from_noise_density(0.005, 200.0);
  const NoiseModel passed = behind_low_pass(white, 42.0, 200.0);
  const auto part = [&](double hz) {
    return noise_spectrum(passed, 2.0 * std::numbers::pi * hz / 200.0) / white.white_variance;
  };
  EXPECT_NEAR(part(5.0), 1.0, 0.15);
  EXPECT_NEAR(part(42.0), 0.5, 0.15);
  EXPECT_NEAR(part(84.0), 1.0 / 17.0, 0.05);
}

// The integral of 1 / (1 + f^4) is pi / sqrt(8): so much of the bandwidth is let through, and all of it is in the samples, whatever their rate.
TEST(NoiseUnits, FoldBackWhatIsFasterThanHalfTheRate) {
  const NoiseModel white = from_noise_density(0.005, 200.0);
  for (const double bandwidth_hz : {20.0, 42.0, 80.0, 142.0, 500.0}) {
    const double all = bandwidth_hz / 100.0 * std::numbers::pi / std::sqrt(8.0);
    EXPECT_NEAR(noise_variance(behind_low_pass(white, bandwidth_hz, 200.0)) / white.white_variance, all,
                0.07 * all)
        << bandwidth_hz;
  }
}

TEST(NoiseUnits, GiveTheCorrelationOfNeighbours) {
  EXPECT_DOUBLE_EQ(lag_one_correlation(NoiseModel{}), 0.0);
  EXPECT_NEAR(lag_one_correlation(white_noise(2.0)), 0.0, 1e-12);
  EXPECT_NEAR(lag_one_correlation(coloured()), 2.0 / 5.0, 1e-9);
}

// A line of variance 3 at 0.1 cycles per sample has the covariance 3 cos(36 degrees) at lag 1, and is no part of what integrates to angle.
TEST(NoiseUnits, KnowWhatALineIs) {
  NoiseModel model = coloured();
  model.line_count = 1;
  model.line[0] = {.cycles = 0.1, .half_width = 0.001, .variance = 3.0};
  EXPECT_NEAR(lag_one_correlation(model), (2.0 + 3.0 * std::cos(0.2 * std::numbers::pi)) / 8.0, 1e-9);
  EXPECT_NEAR(angle_random_walk(model, 100.0), std::sqrt(0.13), 1e-12);
  EXPECT_NEAR(noise_density(model, 100.0), std::sqrt(0.16), 1e-12);
  // Of what is not a line the density stays, of the line the power.
  EXPECT_EQ(at_rate(model, 100.0, 200.0), white_noise(13.0));
}

TEST(NoiseUnits, KeepTheDensityAtAnotherRate) {
  EXPECT_EQ(at_rate(coloured(), 100.0, 101.0), coloured());
  const NoiseModel twice = at_rate(coloured(), 100.0, 200.0);
  EXPECT_EQ(twice, white_noise(10.0));
  EXPECT_NEAR(noise_density(twice, 200.0), noise_density(coloured(), 100.0), 1e-15);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(at_rate(coloured(), 100.0, 100.0 + 1.9 * sign), coloured()) << "two in a hundred are the same";
    EXPECT_EQ(at_rate(coloured(), 100.0, 100.0 + 2.1 * sign).colour_order, 0U) << sign;
  }
}

}  // namespace
}  // namespace gyrod::core
