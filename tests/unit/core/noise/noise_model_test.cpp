#include "core/noise/noise_model.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

/// White noise of variance 1 plus an AR(1) of pole 0.5 driven by variance 3, which has variance 3 / (1 - 0.25) = 4.
NoiseModel coloured() {
  NoiseModel model = white_noise(1.0);
  model.colour_order = 1;
  model.colour[0] = 0.5;
  model.colour_variance = 3.0;
  return model;
}

TEST(NoiseModel, HasTheVarianceOfItsParts) {
  EXPECT_DOUBLE_EQ(noise_variance(white_noise(2.5)), 2.5);
  EXPECT_DOUBLE_EQ(noise_variance(coloured()), 5.0);
}

TEST(NoiseModel, HasTheSpectrumOfItsParts) {
  // 1 + 3 / |1 - 0.5 e^-iw|^2: 1 + 3 / 0.25 at w = 0, 1 + 3 / 2.25 at w = pi.
  EXPECT_DOUBLE_EQ(noise_spectrum(coloured(), 0.0), 13.0);
  EXPECT_NEAR(noise_spectrum(coloured(), std::numbers::pi), 1.0 + 3.0 / 2.25, 1e-12);
  EXPECT_DOUBLE_EQ(noise_spectrum(white_noise(2.5), 1.0), 2.5);
}

TEST(NoiseModel, SpreadsItsVarianceOverTheSpectrum) {
  // The mean over equally spaced frequencies of a full turn is the variance, to the aliasing of 0.5^200.
  double sum = 0.0;
  for (int k = 0; k < 200; ++k) sum += noise_spectrum(coloured(), 2.0 * std::numbers::pi * k / 200.0);
  EXPECT_NEAR(sum / 200.0, 5.0, 1e-12);
}

TEST(NoiseModel, ScalesAsAnAmplitude) {
  EXPECT_DOUBLE_EQ(noise_variance(scaled(coloured(), 3.0)), 45.0);
  EXPECT_EQ(scaled(coloured(), 3.0).colour, coloured().colour);
}

TEST(NoiseModel, IsUsableOnlyIfFinitePositiveAndStable) {
  EXPECT_TRUE(is_usable(coloured()));
  EXPECT_TRUE(is_usable(white_noise(1e-12)));
  EXPECT_FALSE(is_usable(NoiseModel{}));
  EXPECT_FALSE(is_usable(white_noise(std::numeric_limits<double>::quiet_NaN())));
  NoiseModel unstable = coloured();
  unstable.colour[0] = 1.0;
  EXPECT_FALSE(is_usable(unstable));
  NoiseModel negative = coloured();
  negative.colour_variance = -1.0;
  EXPECT_FALSE(is_usable(negative));
}

}  // namespace
}  // namespace gyrod::core
