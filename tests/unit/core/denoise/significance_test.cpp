// The scatter of white noise's energies against the chi-squared distribution it stands for, and the rule on figures made for the
// purpose.
#include "core/denoise/significance.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/denoise/noise_line.hpp"
#include "core/signal/chi_squared.hpp"
#include "denoiser_support.hpp"

namespace gyrod {
namespace {

using core::ImfClass;
using core::NoiseBand;
using core::ScreeningRule;
using core::SignificanceTest;
using namespace testing;

// The tails of chi-squared(nu) / nu at the band's bounds are half the false-alarm rate each; Wilson and Hilferty at 20 degrees makes
// less than a fifth of that.
TEST(SignificanceTest, BandLeavesTheFalseAlarmRateOfChiSquaredOutside) {
  for (const double rate : {0.01, 0.05}) {
    for (const std::size_t imf : {2U, 4U, 5U}) {
      const double freedom = core::noise_freedom(imf, 1024);
      const NoiseBand band = SignificanceTest(rate).band(imf, 1024);
      const double above = core::chi_squared_tail(band.upper * freedom, freedom);
      const double below = core::chi_squared_probability(band.lower * freedom, freedom);
      EXPECT_NEAR(above, 0.5 * rate, 0.1 * rate) << "IMF " << imf;
      EXPECT_NEAR(below, 0.5 * rate, 0.1 * rate) << "IMF " << imf;
    }
  }
}

TEST(SignificanceTest, ProbabilityIsTheFalseAlarmRateOnTheBandsBounds) {
  for (const std::size_t imf : {1U, 3U, 6U}) {
    const NoiseBand band = SignificanceTest(0.01).band(imf, 2048);
    EXPECT_NEAR(SignificanceTest::p_value(band.lower, imf, 2048), 0.01, 1e-9);
    EXPECT_NEAR(SignificanceTest::p_value(band.upper, imf, 2048), 0.01, 1e-9);
    EXPECT_GT(SignificanceTest::p_value(1.0, imf, 2048), 0.5);
    EXPECT_LT(SignificanceTest::p_value(30.0, imf, 2048), 1e-9);
  }
}

// nu = a N / T: twice the window, twice the degrees of freedom, until there is less than one.
TEST(NoiseFreedom, GrowsWithTheWindowAndFallsWithThePeriod) {
  for (std::size_t imf = 1; imf <= 7; ++imf) {
    EXPECT_NEAR(core::noise_freedom(imf, 4096) / core::noise_freedom(imf, 2048), 2.0, 1e-12);
    EXPECT_GT(core::noise_freedom(imf, 1024), core::noise_freedom(imf + 1, 1024));
  }
  EXPECT_EQ(core::noise_freedom(20, 1024), 1.0);
}

TEST(SignificanceTest, RefusesRatesThatAreNone) {
  for (const double rate : {0.0, -0.01, 1.0, std::nan("")})
    EXPECT_THROW(SignificanceTest{rate}, std::invalid_argument) << rate;
}

TEST(SignificanceRule, IsRefusedForAnEmdThatTheNoiseLineWasNotMadeFor) {
  core::DenoiserOptions options = with_rule(ScreeningRule::kSignificance);
  options.emd.sifts = 8;
  EXPECT_THROW(core::Denoiser(1024, options), std::invalid_argument);
  options = with_rule(ScreeningRule::kSignificance);
  options.emd.boundary = core::BoundaryRule::kLinear;
  EXPECT_THROW(core::Denoiser(1024, options), std::invalid_argument);
}

// A window of noise has no evidence against it in most IMFs, and one with a tone of five times the noise's size has it at the tone's IMF:
// period 40 lies in IMF 4 or 5 (T = 24 and 48).
TEST(SignificanceRule, SeesAToneAndShowsItsEvidence) {
  const auto noise = white_noise(1024, 5);
  const auto with_tone = sum(noise, tone(1024, 1.0 / 40.0), 5.0);
  const auto quiet = denoise(noise, with_rule(ScreeningRule::kSignificance)).report;
  const auto loud = denoise(with_tone, with_rule(ScreeningRule::kSignificance)).report;
  EXPECT_GE(quiet.j, 4U);
  EXPECT_LE(loud.k, 4U);
  const core::ImfFigures& signal = loud.imf[loud.k];
  EXPECT_EQ(signal.imf_class, ImfClass::kSignal);
  EXPECT_GT(signal.excess, 30.0);
  EXPECT_LT(signal.noise_probability, 1e-9);
  EXPECT_LT(signal.noise_excess_low, 1.0);
  EXPECT_GT(signal.noise_excess_high, 1.0);
}

}  // namespace
}  // namespace gyrod
