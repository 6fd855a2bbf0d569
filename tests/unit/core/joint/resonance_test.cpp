// What the modes of the IMFs leave unexplained: bands of the spectrum that get a mode of their own.
#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "core/joint/whittle_fit.hpp"
#include "support/signals.hpp"
#include "unit/core/joint/joint_support.hpp"
#include "unit/core/joint/line_support.hpp"

namespace gyrod {
namespace {

using core::ModeSet;
using core::WhittleFit;
using testing::Signal;

constexpr std::size_t kSeenSamples = 1024;
constexpr std::size_t kSeenBins = kSeenSamples / 2 + 1;

/// A slow mode without power worth speaking of.
ModeSet hardly_anything() {
  ModeSet modes;
  modes.add({.a = {0.9, 0.0, 0.0}, .drive = 1e-12, .slow = true});
  return modes;
}

Signal times_in(Signal power, std::size_t first, std::size_t bins, double factor) {
  for (std::size_t k = first; k < first + bins; ++k) power[k] *= factor;
  return power;
}

// 16 bins of three times the noise: 2 16 (3 - 1 - ln 3) of twice the log-likelihood, and 2 16 2 / 1024 of variance, both signs counted.
TEST(LeastExplained, IsTheBandThatBuysMost) {
  WhittleFit fit(kSeenSamples, 0.001);
  fit.observe(times_in(Signal(kSeenBins, 1.0), 100, 16, 3.0), core::white_noise(1.0));
  const WhittleFit::Band band = fit.least_explained(hardly_anything());
  EXPECT_NEAR(band.gain, 32.0 * (2.0 - std::log(3.0)), 1e-9);
  EXPECT_NEAR(band.centre_cycles, 107.5 / kSeenSamples, 1e-12);
  EXPECT_NEAR(band.width_cycles, 16.0 / kSeenSamples, 1e-12);
  EXPECT_NEAR(band.power, 0.0625, 1e-9);
}

TEST(LeastExplained, HasNoGainWhereNothingIsMissing) {
  WhittleFit fit(kSeenSamples, 0.001);
  fit.observe(times_in(Signal(kSeenBins, 1.0), 200, 64, 0.2), core::white_noise(1.0));
  EXPECT_EQ(fit.least_explained(hardly_anything()).gain, 0.0) << "too little is not missing";
  fit.observe(Signal(kSeenBins, 1.0), core::white_noise(1.0));
  EXPECT_EQ(fit.least_explained(hardly_anything()).gain, 0.0);
}

TEST(LeastExplained, LeavesOutWhatALineOfTheNoiseMayHold) {
  WhittleFit fit(kSeenSamples, 0.001);
  const core::NoiseModel noise = testing::noise_with_line(0.2, 3.0);
  fit.observe(Signal(kSeenBins, 1.0), noise);
  Signal power(fit.noise().begin(), fit.noise().end());
  const Signal rest(fit.noise_without_lines().begin(), fit.noise_without_lines().end());
  std::size_t louder = 0;
  for (std::size_t k = 0; k < kSeenBins; ++k) {
    if (power[k] < 1.3 * rest[k]) continue;
    power[k] *= 4.0;
    ++louder;
  }
  ASSERT_GT(louder, 8U);
  fit.observe(power);
  EXPECT_LT(fit.least_explained(hardly_anything()).gain, 1e-6);
  fit.observe(times_in(power, 400, 16, 3.0));
  EXPECT_NEAR(fit.least_explained(hardly_anything()).centre_cycles, 407.5 / kSeenSamples, 1e-12);
}

core::JointOptions without_resonances() {
  core::JointOptions options;
  options.resonances = 0;
  return options;
}

std::size_t modes_of(const Signal& z, const core::JointOptions& options) {
  core::JointFit fit(kSeenSamples, options);
  core::JointModel model;
  core::WindowReport report;
  fit.fit(z, core::white_noise(1.0), model, report);
  return report.modes;
}

// 38 of 300 windows when this was written.
TEST(Resonances, WhiteNoiseHasFew) {
  constexpr unsigned kWindows = 100;
  std::size_t found = 0;
  for (unsigned seed = 0; seed < kWindows; ++seed) {
    const Signal noise = testing::white_noise(kSeenSamples, seed);
    const std::size_t more = modes_of(noise, {}) - modes_of(noise, without_resonances());
    EXPECT_LE(more, 3U);
    found += more > 0 ? 1U : 0U;
  }
  RecordProperty("windows_with_resonances", static_cast<int>(found));
  EXPECT_LT(found, kWindows / 4);
  EXPECT_GT(found, 0U) << "the threshold is not out of reach";
}

// Four orders of an engine and a swing. One tone stands out most; the IMFs that hold the others are an octave wide.
TEST(Resonances, GetTheirOwnModes) {
  constexpr std::size_t kSize = 6000;
  const Signal swing = testing::times(testing::tone(kSize, 0.005), 2.0);
  Signal truth = swing;
  for (const double cycles : {0.16, 0.2, 0.24, 0.31})
    truth = testing::sum(truth, testing::tone(kSize, cycles));
  const Signal z = testing::sum(truth, testing::white_noise(kSize, 4));
  const auto error = [&](const core::JointOptions& options) {
    return testing::denoised_error(truth, z, 2000, options);
  };
  // The lasting member finds them by itself.
  core::JointOptions with;
  core::JointOptions without = without_resonances();
  with.lasting_log_prior = without.lasting_log_prior = -100.0;
  EXPECT_LT(error(with), 0.85 * error(without));
}

}  // namespace
}  // namespace gyrod
