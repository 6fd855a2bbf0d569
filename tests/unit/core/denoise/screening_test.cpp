// Both rule sets on figures made for the purpose, and the figures on signals with known ones.
#include "core/denoise/screening.hpp"

#include <gtest/gtest.h>

#include "core/emd/emd.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::ImfClass;
using core::ImfFigures;
using core::ScreeningOptions;
using core::ScreeningRule;
using core::WindowReport;
using namespace testing;

constexpr ScreeningOptions kPaper{.rule = ScreeningRule::kPaper};
constexpr ScreeningOptions kWindowed{.rule = ScreeningRule::kWindowed};

ImfFigures with_pcc(double pcc, double excess = 1.0) {
  ImfFigures figures;
  figures.pcc = pcc;
  figures.excess = excess;
  return figures;
}

/// j of a window with these modes, all on the noise side of k.
std::size_t j_of(const std::vector<ImfFigures>& modes, const ScreeningOptions& options) {
  WindowReport report;
  report.imf_count = modes.size();
  report.k = modes.size();
  std::ranges::copy(modes, report.imf.begin());
  core::partition(report, options);
  return report.j;
}

TEST(PaperRule, TakesAnAcfVarianceAboveTheThresholdForSignal) {
  ImfFigures figures;
  figures.acf_concentration = 100.0;
  figures.mean_period_samples = 1e5;
  figures.acf_variance = 0.001;
  EXPECT_FALSE(core::is_signal(figures, kPaper)) << "at the threshold, whatever the other figures";
  figures.acf_variance = 0.0010001;
  EXPECT_TRUE(core::is_signal(figures, kPaper));
}

TEST(WindowedRule, TakesAConcentratedASlowOrAStrongModeForSignal) {
  ImfFigures figures;
  figures.acf_variance = 0.5;
  figures.acf_concentration = 1.2;
  figures.mean_period_samples = 800.0;
  EXPECT_FALSE(core::is_signal(figures, kWindowed)) << "at both thresholds, whatever the variance";
  figures.acf_concentration = 1.21;
  EXPECT_TRUE(core::is_signal(figures, kWindowed));
  figures.acf_concentration = 0.45;
  figures.mean_period_samples = 801.0;
  EXPECT_TRUE(core::is_signal(figures, kWindowed));
  figures.mean_period_samples = 100.0;
  figures.excess = 30.0;
  EXPECT_FALSE(core::is_signal(figures, kWindowed)) << "at the threshold";
  figures.excess = 30.1;
  EXPECT_TRUE(core::is_signal(figures, kWindowed));
}

// [Yang2019] Table 1: very weak ends at 0.19, weak begins at 0.20.
TEST(PccBoundary, LiesBeforeTheFirstVeryWeakMode) {
  EXPECT_EQ(j_of({with_pcc(0.55), with_pcc(0.3), with_pcc(0.199), with_pcc(0.5)}, kPaper), 2U);
  EXPECT_EQ(j_of({with_pcc(0.2), with_pcc(-0.4), with_pcc(0.1)}, kPaper), 2U)
      << "0.20 is weak, and so is -0.4";
  EXPECT_EQ(j_of({with_pcc(0.1), with_pcc(0.9)}, kPaper), 0U);
  EXPECT_EQ(j_of({}, kPaper), 0U);
}

TEST(PccBoundary, IsKAtTheMost) { EXPECT_EQ(j_of({with_pcc(0.9), with_pcc(0.9)}, kPaper), 2U); }

TEST(PccBoundary, StopsUnderTheWindowedRuleAtAModeAboveTheNoiseLine) {
  const std::vector modes{with_pcc(0.8, 1.0), with_pcc(0.5, 2.0), with_pcc(0.4, 2.01)};
  EXPECT_EQ(j_of(modes, kWindowed), 2U) << "twice the line is still noise";
  EXPECT_EQ(j_of(modes, kPaper), 3U) << "the paper knows no noise line";
}

TEST(Partition, NamesNoiseMixedAndSignalModesInTheirOrder) {
  WindowReport report;
  report.imf_count = 5;
  report.k = 3;
  report.imf[0] = with_pcc(0.6);
  for (std::size_t i = 1; i < 5; ++i) {
    report.imf[i] = with_pcc(0.1);
  }
  core::partition(report, kWindowed);
  EXPECT_EQ(report.j, 1U);
  const std::array expected{ImfClass::kNoise, ImfClass::kMixed, ImfClass::kMixed, ImfClass::kSignal,
                            ImfClass::kSignal};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(report.imf[i].imf_class, expected[i]) << i;
  }
}

// White noise itself has c = 3 / 4: variance 3 / (2 N), period 2. Values of its modes: measured here, over
// 400 windows of each size; they spread by 0.02 between the sizes, and 100 windows by as much.
TEST(ImfFigures, OfNoiseDoNotDependOnTheWindowAndLieOnTheLine) {
  constexpr unsigned kSeeds = 100;
  constexpr std::array kConcentration{0.63, 0.54, 0.51, 0.475, 0.445};
  for (const std::size_t size : {512U, 1024U, 4096U}) {
    core::Emd emd(size);
    core::Autocorrelation autocorrelation(size);
    Signal imf(size);
    std::array<double, 5> concentration{};
    std::array<double, 5> excess{};
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      emd.start(times(white_noise(size, seed), 3.0));
      for (std::size_t i = 0; i < 5 && emd.next_imf(imf); ++i) {
        const ImfFigures figures = core::imf_figures(imf, i + 1, 9.0, autocorrelation);
        EXPECT_FALSE(core::is_signal(figures, kWindowed)) << "IMF " << i + 1 << " of " << size;
        concentration[i] += figures.acf_concentration / kSeeds;
        excess[i] += figures.excess / kSeeds;
      }
    }
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(concentration[i], kConcentration[i], 0.04) << "IMF " << i + 1 << " of " << size;
      EXPECT_NEAR(excess[i], 1.0, 0.05) << "IMF " << i + 1 << " of " << size;
    }
  }
}

// 50 whole periods of 20 samples with amplitude 2: variance 2. Its biased ACF is (1 - l/N) cos(w l), whose
// variance is 1/6 but for terms of 1/N: c = N / 6 / 20.
TEST(ImfFigures, OfAToneAreItsOwn) {
  core::Autocorrelation autocorrelation(1000);
  const ImfFigures figures = core::imf_figures(times(tone(1000, 0.05, 1.0), 2.0), 1, 1.0, autocorrelation);
  EXPECT_NEAR(figures.energy, 2.0, 1e-12);
  EXPECT_NEAR(figures.mean_period_samples, 20.0, 0.3);
  EXPECT_NEAR(figures.acf_variance, 1.0 / 6.0, 1e-3);
  EXPECT_NEAR(figures.acf_concentration, 1000.0 / 6.0 / 20.0, 0.2);
}

TEST(ImfFigures, HaveNoExcessWhereTheFloorIsUnknown) {
  core::Autocorrelation autocorrelation(100);
  EXPECT_EQ(core::imf_figures(white_noise(100, 1), 1, 0.0, autocorrelation).excess, 0.0);
}

}  // namespace
}  // namespace gyrod
