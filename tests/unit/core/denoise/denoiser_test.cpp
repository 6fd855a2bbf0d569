// What holds for every window: scale, offset, finiteness, and a report that agrees with the output.
#include "core/denoise/denoiser.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/signal/moments.hpp"
#include "unit/core/denoise/denoiser_support.hpp"

namespace gyrod {
namespace {

using core::Denoiser;
using core::ImfClass;
using core::ScreeningRule;
using namespace testing;

class DenoiserRule : public ::testing::TestWithParam<ScreeningRule> {
 protected:
  Denoised denoise(const Signal& window) const { return testing::denoise(window, with_rule(GetParam())); }
};

INSTANTIATE_TEST_SUITE_P(BothRules, DenoiserRule,
                         ::testing::Values(ScreeningRule::kPaper, ScreeningRule::kWindowed,
                                           ScreeningRule::kSignificance));

/// A slow swing in noise, rad/s.
Signal noisy_swing(std::size_t size, unsigned seed) {
  return sum(times(tone(size, 0.003), 0.1), white_noise(size, seed), 0.006);
}

TEST_P(DenoiserRule, ScalingByAPowerOfTwoScalesEveryBit) {
  const Signal window = noisy_swing(1024, 1);
  const Denoised result = denoise(window);
  for (const int exponent : {-60, -6, 1, 40}) {
    const double factor = std::ldexp(1.0, exponent);
    const Denoised scaled = denoise(times(window, factor));
    EXPECT_EQ(times(scaled.out, 1.0 / factor), result.out) << exponent;
    EXPECT_EQ(scaled.report.noise_floor, factor * result.report.noise_floor);
    EXPECT_EQ(scaled.report.output_noise, factor * result.report.output_noise);
  }
}

// The offset rounds the window at 1e-16; a filter's gain passes that on undiminished.
TEST_P(DenoiserRule, OffsetMovesOnlyTheMean) {
  const Signal window = noisy_swing(1024, 2);
  const Signal offset(window.size(), 0.5);
  const Denoised moved = denoise(sum(window, offset));
  const Denoised result = denoise(window);
  EXPECT_LE(peak(sum(sum(moved.out, offset, -1.0), result.out, -1.0)), 1e-12);
  EXPECT_NEAR(moved.report.mean, result.report.mean + 0.5, 1e-15);
}

TEST_P(DenoiserRule, ZeroStaysZero) {
  const Denoised result = denoise(Signal(1024));
  EXPECT_EQ(result.out, Signal(1024));
  EXPECT_EQ(result.report.imf_count, 0U);
  EXPECT_EQ(result.report.noise_floor, 0.0);
  EXPECT_EQ(result.report.output_noise, 0.0);
}

TEST_P(DenoiserRule, ConstantAndRampStayWhatTheyAre) {
  Signal ramp(1024);
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    ramp[k] = 0.1 - 0.001 * static_cast<double>(k);
  }
  for (const Signal& window : {Signal(1024, -0.1), ramp}) {
    EXPECT_EQ(denoise(window).out, window);
  }
}

/// Finite windows that no gyro gives, and some that a broken one does.
std::vector<Signal> hostile_windows(std::size_t size) {
  Signal impulse(size);
  impulse[size / 3] = 1e6;
  Signal step(size, -1.0);
  std::fill_n(step.begin(), size / 2, 1.0);
  Signal alternating(size);
  Signal stuck = white_noise(size, 1);
  Signal growing(size);
  for (std::size_t k = 0; k < size; ++k) {
    alternating[k] = k % 2 == 0 ? 1.0 : -1.0;
    stuck[k] = stuck[k - k % 7];
    growing[k] = std::pow(1.02, static_cast<double>(k)) * std::cos(0.3 * static_cast<double>(k));
  }
  const Signal noise = white_noise(size, 2);
  return {impulse,
          step,
          alternating,
          stuck,
          growing,
          noise,
          quantised(noise, 0.5),
          quantised(noise, 3.0),
          tone(size, 0.25),
          tone(size, 0.5 / static_cast<double>(size)),
          sum(tone(size, 0.01), noise, 1e-12),
          sum(noise, Signal(size, 1e9))};
}

TEST_P(DenoiserRule, GivesFiniteAnswersToFiniteWindows) {
  for (const std::size_t size : {std::size_t{16}, std::size_t{17}, std::size_t{100}, std::size_t{1024}}) {
    const std::vector<Signal> windows = hostile_windows(size);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      for (const double scale : {1.0, 1e-300, 1e-155, 1e150, 1e290}) {
        const Denoised result = denoise(times(windows[i], scale));
        EXPECT_TRUE(is_finite(result.out)) << "window " << i << " of " << size << " times " << scale;
      }
    }
  }
}

// The figures square the input, so they leave the range of double before the output does: rad/s up to 1e100
// and down to 1e-100 keep them in range.
TEST_P(DenoiserRule, GivesFiniteFiguresToFiniteWindows) {
  for (const Signal& window : hostile_windows(1024)) {
    for (const double scale : {1e-80, 1.0, 1e60}) {
      const core::WindowReport report = denoise(times(window, scale)).report;
      EXPECT_TRUE(std::isfinite(report.mean + report.noise_floor + report.output_noise));
      for (std::size_t i = 0; i < report.imf_count; ++i) {
        const core::ImfFigures& imf = report.imf[i];
        EXPECT_TRUE(std::isfinite(imf.pcc + imf.acf_variance + imf.acf_concentration +
                                  imf.mean_period_samples + imf.energy + imf.excess));
        EXPECT_TRUE(is_finite(imf.model.ar_coefficients));
      }
    }
  }
}

TEST_P(DenoiserRule, ReportAgreesWithThePartition) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const core::WindowReport report = denoise(noisy_swing(1024, seed)).report;
    EXPECT_EQ(report.window_samples, 1024U);
    EXPECT_LE(report.j, report.k);
    EXPECT_LE(report.k, report.imf_count);
    for (std::size_t i = 0; i < report.imf_count; ++i) {
      const bool is_mixed = i >= report.j && i < report.k;
      EXPECT_EQ(report.imf[i].imf_class == ImfClass::kMixed, is_mixed);
      EXPECT_EQ(report.imf[i].model.ar_order > 0, is_mixed) << "a model is made of mixed modes only";
    }
  }
}

TEST_P(DenoiserRule, UsedObjectGivesTheBitsOfAFreshOne) {
  Denoiser used(1024, with_rule(GetParam()));
  core::WindowReport report;
  for (const std::size_t size : {1024U, 16U, 700U, 1024U}) {
    const Signal window = noisy_swing(size, 3);
    Signal out(size);
    used.denoise(window, out, report);
    EXPECT_EQ(out, denoise(window).out) << size;
  }
}

// White noise alone gives IMF 1 a PCC of 0.75. Against the raw window it would be 0.04 here, and no mode
// noise.
TEST(Denoiser, ComparesTheNoiseModesWithTheNoiseWhateverTheMotion) {
  for (const double period : {1000.0, 500.0, 200.0, 100.0}) {
    const Signal window = sum(white_noise(1024, 4), tone(1024, 1.0 / period), 30.0);
    const core::WindowReport report = denoise(window).report;
    EXPECT_GE(report.j, 1U) << period;
    EXPECT_NEAR(report.imf[0].pcc, 0.75, 0.15) << period;
  }
}

TEST(Denoiser, TakesAWindowApartToTheEndUnderThePaperRuleAndToTheFirstSignalModeElse) {
  const Signal window = sum(tone(1024, 0.02), white_noise(1024, 5), 0.1);
  core::Emd emd(window.size());
  Signal imf(window.size());
  std::size_t modes = 0;
  for (emd.start(window); emd.next_imf(imf);) {
    ++modes;
  }
  EXPECT_EQ(denoise(window, with_rule(ScreeningRule::kPaper)).report.imf_count, modes);
  const core::WindowReport windowed = denoise(window).report;
  EXPECT_EQ(windowed.imf_count, windowed.k + 1);
  EXPECT_LT(windowed.imf_count, modes);
}

TEST(Denoiser, RefusesOptionsOutsideTheirRange) {
  core::DenoiserOptions options;
  options.emd.sifts = 0;
  EXPECT_THROW(Denoiser(1024, options), std::invalid_argument);
  options = {};
  options.max_ar_order = 0;
  EXPECT_THROW(Denoiser(1024, options), std::invalid_argument);
  options.max_ar_order = core::kMaxArOrder + 1;
  EXPECT_THROW(Denoiser(1024, options), std::invalid_argument);
}

}  // namespace
}  // namespace gyrod
