// A noise model from a spectrum, apart from what the spectrum is of.
#include "core/noise/noise_fit.hpp"

#include <cstddef>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

/// Mean over a full turn: the ends once, all others for both signs.
double mean_power(const NoiseSpectrum& power) {
  double sum = power.front() + power.back();
  for (std::size_t k = 1; k + 1 < kNoiseBins; ++k) sum += 2.0 * power[k];
  return sum / static_cast<double>(kNoiseSegment);
}

// Half of the band lies below the white part that is asked for. What is cut off there is taken from the colour: the level stays that of the spectrum.
TEST(NoiseFit, KeepsTheLevelWhereTheSpectrumLiesBelowTheWhitePart) {
  NoiseSpectrum power{};
  for (std::size_t k = 0; k < kNoiseBins; ++k) power[k] = k < kNoiseBins / 2 ? 1.0 : 0.2;
  for (const double white : {0.1, 0.3, 0.5}) {
    const auto model = fit_noise(power, white);
    ASSERT_TRUE(model.has_value());
    EXPECT_EQ(model->white_variance, white);
    EXPECT_NEAR(noise_variance(*model), mean_power(power), 1e-9) << white;
  }
}

// A filter needs a white part: where the spectrum has a hole, a ten-thousandth of the variance; else half of the least level.
TEST(NoiseFit, HasAWhitePart) {
  NoiseSpectrum power{};
  for (std::size_t k = 0; k < kNoiseBins; ++k) power[k] = k < kNoiseBins / 2 ? 1.0 : 0.2;
  EXPECT_NEAR(fit_noise(power)->white_variance, 0.1, 1e-12);
  for (std::size_t k = kNoiseBins / 2; k < kNoiseBins; ++k) power[k] = 0.0;
  EXPECT_NEAR(fit_noise(power)->white_variance, 1e-4 * mean_power(power), 1e-12);
  EXPECT_NEAR(noise_variance(*fit_noise(power)), mean_power(power), 1e-9);
}

}  // namespace
}  // namespace gyrod::core
