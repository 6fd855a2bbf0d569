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

/// White noise of 1 with a line of variance 3 at a tenth of the sample rate, and one at 0.45.
NoiseModel with_lines() {
  NoiseModel model = white_noise(1.0);
  model.line_count = 2;
  model.line[0] = {.cycles = 0.1, .half_width = 0.001, .variance = 3.0};
  model.line[1] = {.cycles = 0.45, .half_width = 0.001, .variance = 2.0};
  return model;
}

TEST(NoiseModel, HasLinesWithinFifteenPerCentOfTheirFrequencies) {
  const auto at = [](double cycles) { return noise_spectrum(with_lines(), 2.0 * std::numbers::pi * cycles); };
  // 3 over 0.03 of 0.5 cycles; 2 over what there is below half a cycle, 0.3825 to 0.5.
  EXPECT_NEAR(at(0.1), 1.0 + 3.0 * 0.5 / 0.03, 1e-9);
  EXPECT_NEAR(at(0.086), 1.0 + 3.0 * 0.5 / 0.03, 1e-9);
  EXPECT_EQ(at(0.084), 1.0);
  EXPECT_EQ(at(0.116), 1.0);
  EXPECT_NEAR(at(0.499), 1.0 + 2.0 * 0.5 / 0.1175, 1e-9);
  EXPECT_NEAR(at(0.6), at(0.4), 1e-9) << "the other half of the turn";
  EXPECT_DOUBLE_EQ(noise_variance(with_lines()), 6.0);
  double sum = 0.0;
  constexpr int kPoints = 20'000;
  for (int k = 0; k < kPoints; ++k) sum += at(0.5 * (k + 0.5) / kPoints);
  EXPECT_NEAR(sum / kPoints, 6.0, 0.01);
  EXPECT_EQ(without_lines(with_lines()), white_noise(1.0));
}

TEST(NoiseModel, ScalesAsAnAmplitude) {
  EXPECT_DOUBLE_EQ(noise_variance(scaled(with_lines(), 3.0)), 54.0);
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
  EXPECT_TRUE(is_usable(with_lines()));
  for (const SpectralLine bad : {SpectralLine{.cycles = 0.5, .half_width = 0.01, .variance = 1.0},
                                 SpectralLine{.cycles = 0.1, .half_width = 0.0, .variance = 1.0},
                                 SpectralLine{.cycles = 0.1, .half_width = 0.01, .variance = -1.0}}) {
    NoiseModel model = with_lines();
    model.line[1] = bad;
    EXPECT_FALSE(is_usable(model));
  }
}

}  // namespace
}  // namespace gyrod::core
