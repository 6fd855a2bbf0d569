#include "core/joint/noise_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

/// Mean power of each band of noise of a shape, by its spectrum.
BandPower bands_of(const NoiseShape& shape) {
  const NoiseModel noise = noise_of(shape);
  constexpr std::size_t kPoints = 400;
  BandPower power{};
  for (std::size_t i = 0; i < kNoiseBands * kPoints; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(kNoiseBands * kPoints);
    power[i / kPoints] += noise_spectrum(noise, std::numbers::pi * part) / static_cast<double>(kPoints);
  }
  return power;
}

TEST(NoiseShape, IsNoiseOfItsLevel) {
  EXPECT_NEAR(noise_variance(noise_of({.level = 2.5, .tilt = 0.7})), 2.5, 1e-12);
  EXPECT_EQ(noise_of({.level = 2.5, .tilt = 0.0}), white_noise(2.5));
  // (1 + c)^2 / (1 - c)^2 = 25 / 9 from one end to the other.
  const NoiseModel tilted = noise_of({.level = 1.0, .tilt = 0.9});
  const double low = (noise_spectrum(tilted, 0.0) - 0.1) / 0.9;
  const double high = (noise_spectrum(tilted, std::numbers::pi) - 0.1) / 0.9;
  EXPECT_NEAR(low / high, 25.0 / 9.0, 1e-12);
}

TEST(NoiseShape, WhiteNoiseIsFoundToBeWhite) {
  BandPower power{};
  power.fill(1.0);
  for (const bool known : {true, false}) {
    const NoiseShape shape = likely_shape(power, known);
    EXPECT_NEAR(shape.level, 1.0, 0.01);
    EXPECT_LT(shape.tilt, 0.06);
  }
}

// A deviation believed 20 % too low or too high, and a colour of which nothing is believed.
TEST(NoiseShape, LevelAndTiltAreFoundTogether) {
  for (const double level : {0.694, 1.0, 1.5625})
    for (const double tilt : {0.3, 0.7}) {
      const NoiseShape shape = likely_shape(bands_of({.level = level, .tilt = tilt}), true);
      EXPECT_NEAR(shape.level, level, 0.03 * level) << tilt;
      EXPECT_NEAR(shape.tilt, tilt, 0.07) << level;
    }
}

// What moves fills the lower bands, and what shakes some band. The others tell the noise; a level that is believed is left for them less readily.
TEST(NoiseShape, MotionIsLeftOut) {
  BandPower power = bands_of({.level = 1.5625, .tilt = 0.7});
  power[0] *= 1000.0;
  power[1] *= 20.0;
  power[3] *= 3.0;
  for (const bool known : {true, false}) {
    const NoiseShape shape = likely_shape(power, known);
    EXPECT_NEAR(shape.level, 1.5625, known ? 0.13 : 0.08);
    EXPECT_NEAR(shape.tilt, 0.7, known ? 0.25 : 0.2);
  }
}

TEST(NoiseShape, ABelievedLevelIsWeighedAgainstTheBands) {
  BandPower power = bands_of({.level = 1.0, .tilt = 0.7});
  for (std::size_t band = 0; band < kNoiseBands; ++band) power[band] *= 3.0 - 0.2 * static_cast<double>(band);
  // Shaken in every band, by less the higher: nearer to what is believed than where nothing is.
  EXPECT_LT(likely_shape(power, true).level, likely_shape(power, false).level);
}

// All of a car shakes, hardly more in one band than in the next: four times what is believed, and for all that no noise.
TEST(NoiseShape, ABelievedLevelIsNotGivenUpForACarThatShakes) {
  const BandPower power = {30.0, 12.0, 9.0, 7.0, 200.0, 50.0, 8.0, 10.0};
  EXPECT_LT(likely_shape(power, true).level, 1.7);
  EXPECT_GT(likely_shape(power, false).level, 5.0);
}

TEST(NoiseShape, ScalesWithThePowerWhereNothingIsBelieved) {
  BandPower power = bands_of({.level = 1.0, .tilt = 0.4});
  power[1] *= 5.0;
  const NoiseShape shape = likely_shape(power, false);
  for (double& value : power) value *= 0x1p-40;
  const NoiseShape scaled = likely_shape(power, false);
  EXPECT_EQ(scaled.level, shape.level * 0x1p-40);
  EXPECT_EQ(scaled.tilt, shape.tilt);
}

TEST(NoiseShape, GoesNoFurtherThanItsBounds) {
  for (const double value : {0.0, 1e-300, 1e-9, 1e9, 1e300}) {
    BandPower power{};
    power.fill(value);
    const NoiseShape shape = likely_shape(power, true);
    EXPECT_GE(shape.level, std::exp(-1.001)) << value;
    EXPECT_LE(shape.level, std::exp(1.501)) << value;
    EXPECT_GE(shape.tilt, 0.0) << value;
    EXPECT_LE(shape.tilt, 0.9) << value;
  }
  BandPower uneven{};
  uneven.fill(1e300);
  uneven[7] = 1e-300;
  EXPECT_TRUE(std::isfinite(likely_shape(uneven, false).level));
}

// One band that is e^-2 of what all others show, as of a notch, does not outweigh seven: beyond -70 it counts no more.
TEST(NoiseShape, OneBandFarBelowDoesNotOutweighTheOthers) {
  BandPower power{};
  power.fill(1.0);
  power[2] = std::exp(-2.0);
  EXPECT_NEAR(likely_shape(power, true).level, 1.0, 0.05);
}

// Within two deviations of a tenth in the logarithm. The shape's means over bands are those of its spectrum to 1e-4.
TEST(NoiseShape, BandsOfNoiseAloneAreThoseWithinTwoDeviations) {
  const NoiseShape shape{.level = 2.0, .tilt = 0.4};
  for (const double off : {-0.21, -0.19, 0.0, 0.19, 0.21}) {
    BandPower power = bands_of(shape);
    for (std::size_t band = 0; band < 3; ++band) power[band] *= std::exp(off);
    EXPECT_EQ(bands_of_noise_alone(power, shape), std::abs(off) < 0.2 ? kNoiseBands : kNoiseBands - 3) << off;
  }
}

TEST(NoiseShape, AnEmptyBandIsNoNoise) {
  BandPower power{};
  power.fill(1.0);
  power[7] = 0.0;
  EXPECT_EQ(likely_shape(power, false).level, 0.0);
}

}  // namespace
}  // namespace gyrod::core
