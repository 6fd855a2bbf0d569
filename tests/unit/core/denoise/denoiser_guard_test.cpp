// The guard metrics of docs/method.md: noise goes down, motion stays. 100 Hz, deg/s, noise as an ADIS16405's
// (0.35).
#include <gtest/gtest.h>

#include "core/signal/moments.hpp"
#include "unit/core/denoise/denoiser_support.hpp"

namespace gyrod {
namespace {

using core::ScreeningRule;
using namespace testing;

constexpr double kRateHz = 100.0;
constexpr double kNoise = 0.35;
constexpr unsigned kSeeds = 100;
constexpr std::size_t kWindow = 1024;

struct Guard {
  double gain = 0.0;            ///< of the motion: slope of the output over the truth
  double error = 0.0;           ///< root mean square, in parts of the noise
  double mean_shift = 0.0;      ///< largest move of a window's mean, in standard errors of the noise's mean
  double stated_noise = 0.0;    ///< root mean square of report.output_noise, in parts of the noise
  double measured_noise = 0.0;  ///< root mean square of report.noise_floor, in parts of the noise
};

/// Mean over windows of a swing in noise, at the default options.
Guard guard(double frequency_hz, double amplitude) {
  Guard result;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Signal truth = times(tone(kWindow, frequency_hz / kRateHz, 0.1 * seed), amplitude);
    const Signal window = sum(truth, white_noise(kWindow, seed), kNoise);
    const Denoised denoised = denoise(window);
    const Signal centred = sum(truth, Signal(kWindow, core::mean(truth)), -1.0);
    double along = 0.0;
    for (std::size_t k = 0; k < kWindow; ++k) {
      along += denoised.out[k] * centred[k];
    }
    result.gain += amplitude > 0.0 ? along / energy(centred) / kSeeds : 0.0;
    result.error += core::mean_square(sum(denoised.out, truth, -1.0)) / kSeeds;
    const double shift = std::abs(core::mean(denoised.out) - core::mean(window));
    result.mean_shift = std::max(result.mean_shift, shift / (kNoise / std::sqrt(kWindow)));
    result.stated_noise += std::pow(denoised.report.output_noise, 2) / kSeeds;
    result.measured_noise += std::pow(denoised.report.noise_floor, 2) / kSeeds;
  }
  for (double* square : {&result.error, &result.stated_noise, &result.measured_noise}) {
    *square = std::sqrt(*square) / kNoise;
  }
  return result;
}

struct Motion {
  double frequency_hz;
  double amplitude;
  double gain_tolerance;
  double error;  ///< measured: what a change must not make worse
};

class DenoiserGuard : public ::testing::TestWithParam<Motion> {
 protected:
  const Guard guard_ = guard(GetParam().frequency_hz, GetParam().amplitude);
};

// No motion, slow turns (gain within 1 %), a swing (2 %) and a long strong turn.
INSTANTIATE_TEST_SUITE_P(Motions, DenoiserGuard,
                         ::testing::Values(Motion{0.1, 0.0, 1.0, 0.215}, Motion{0.1, 5.0, 0.01, 0.225},
                                           Motion{0.2, 2.0, 0.01, 0.222}, Motion{1.0, 5.0, 0.02, 0.447},
                                           Motion{0.02, 20.0, 0.01, 0.227}));

TEST_P(DenoiserGuard, MotionIsNotShrunk) {
  if (GetParam().amplitude > 0.0) {
    EXPECT_NEAR(guard_.gain, 1.0, GetParam().gain_tolerance);
  }
}

// 5 %: what another hundred windows may differ by.
TEST_P(DenoiserGuard, ErrorIsTheShareOfTheNoiseItWas) { EXPECT_LE(guard_.error, 1.05 * GetParam().error); }

TEST_P(DenoiserGuard, MeanMovesByLessThanThreeStandardErrors) { EXPECT_LT(guard_.mean_shift, 3.0); }

TEST_P(DenoiserGuard, ReportStatesTheNoiseOfTheInput) { EXPECT_NEAR(guard_.measured_noise, 1.0, 0.02); }

TEST_P(DenoiserGuard, ReportStatesTheNoiseLeftInTheOutput) {
  EXPECT_NEAR(guard_.stated_noise / guard_.error, 1.0, 0.05);
}

// A tone alone has no noise side: the paper's k = 0, and all is kept. 1e-14: the modes are put together
// again.
TEST(DenoiserGuardPaperRule, KeepsAPureTone) {
  for (const double period : {12.0, 50.0, 300.0}) {
    const Signal window = times(tone(kWindow, 1.0 / period, 0.3), 5.0);
    EXPECT_LE(peak(sum(denoise(window, with_rule(ScreeningRule::kPaper)).out, window, -1.0)), 5e-14)
        << period;
  }
}

// Vibration that is there: a 27 Hz engine tone of ten times the noise comes through under the windowed rule
// too.
TEST(DenoiserGuardWindowedRule, KeepsAStrongVibration) {
  const Signal vibration = times(tone(kWindow, 0.27), 10.0 * kNoise);
  const Signal window = sum(vibration, white_noise(kWindow, 1), kNoise);
  const Signal out = denoise(window).out;
  double along = 0.0;
  for (std::size_t k = 0; k < kWindow; ++k) {
    along += out[k] * vibration[k];
  }
  EXPECT_NEAR(along / energy(vibration), 1.0, 0.02);
}

}  // namespace
}  // namespace gyrod
