// What each scheme keeps, and that the analysis of a record agrees with the denoiser.
#include "core/denoise/scheme.hpp"

#include <gtest/gtest.h>

#include "core/denoise/record_analysis.hpp"
#include "core/signal/moments.hpp"
#include "support/arma_process.hpp"
#include "unit/core/denoise/denoiser_support.hpp"

namespace gyrod {
namespace {

using core::RecordAnalysis;
using core::Scheme;
using namespace testing;

Denoised by(Scheme scheme, const Signal& record,
            core::DenoiserOptions options = core::whole_record_options()) {
  options.scheme = scheme;
  return denoise(record, options);
}

/// Long enough for the literal rule to find mixed IMFs: 0.001 N / 0.45 is then a period of 133 samples.
constexpr std::size_t kMixedSize = 60000;

/// A still sensor, deg/s: mean, white noise and a slow drift.
Signal still_record(std::size_t size, unsigned seed) {
  Signal record = sum(white_noise(size, seed), tone(size, 2e-4), 0.3);
  return sum(record, Signal(size, 1.0), 0.4);
}

TEST(Scheme, NamesGoBothWays) {
  for (const Scheme scheme : core::kAllSchemes) EXPECT_EQ(core::scheme_of(core::name_of(scheme)), scheme);
  EXPECT_EQ(core::name_of(Scheme::kAcfEmd), "acf-emd");
  EXPECT_FALSE(core::scheme_of("IMPROVED"));
  EXPECT_FALSE(core::scheme_of(""));
}

TEST(Scheme, RawIsTheInput) {
  const Signal record = still_record(4000, 1);
  EXPECT_EQ(by(Scheme::kRaw, record).out, record);
}

// Completeness of the EMD: what is dropped and what is kept add up to the record.
TEST(Scheme, EmdDropsTheFirstJAndAcfEmdTheFirstK) {
  const Signal record = still_record(kMixedSize, 2);
  core::DenoiserOptions options = core::whole_record_options();
  options.keep_mean = false;
  const RecordAnalysis analysis = core::analyse_record(record, options);
  ASSERT_GT(analysis.report.j, 0U);
  ASSERT_GT(analysis.report.k, analysis.report.j);
  for (const auto& [scheme, dropped] :
       {std::pair{Scheme::kEmd, analysis.report.j}, std::pair{Scheme::kAcfEmd, analysis.report.k}}) {
    Signal all = by(scheme, record, options).out;
    for (std::size_t i = 0; i < dropped; ++i) all = sum(all, analysis.imfs[i]);
    EXPECT_LE(peak(sum(all, record, -1.0)), 1e-13) << core::name_of(scheme);
  }
}

// The closed form behind the scheme direct: an AR(1) record with R = s^2, q its innovation variance, through the filter of ArKalman.
TEST(Scheme, DirectIsTheKalmanFilterOfTheRecordsModel) {
  const Signal record = sum(autoregressive(std::array{0.3}, 4000, 3), Signal(4000, 1.0), 5.0);
  core::DenoiserOptions options;
  options.max_ar_order = 1;
  const Denoised direct = by(Scheme::kDirect, record, options);
  ASSERT_TRUE(direct.report.direct_model.used);
  ASSERT_EQ(direct.report.direct_model.ar_order, 1U);
  const double mean = core::mean(record);
  Signal expected = sum(record, Signal(record.size(), 1.0), -mean);
  core::ArKalman kalman;
  const double floor = direct.report.noise_floor;
  ASSERT_TRUE(kalman.design(std::array{direct.report.direct_model.ar_coefficients[0]},
                            direct.report.direct_model.innovation_variance, floor * floor));
  kalman.filter(expected);
  expected = sum(expected, Signal(record.size(), 1.0), mean);
  EXPECT_LE(peak(sum(direct.out, expected, -1.0)), 1e-13);
}

// docs/method.md: q and R of a white record are both its variance, so K = 1/2, from either family of models. 0.5 to 0.6: IMF 1 tells
// the noise's variance to 1 % of 20 000 samples, and [Yang2019] Table 5 has 0.1936 / 0.3520 = 0.55 on a slightly coloured record.
TEST(Scheme, DirectHalvesWhiteNoise) {
  const Signal record = white_noise(20000, 4);
  for (const core::DenoiserOptions& options : {core::DenoiserOptions{}, core::whole_record_options()}) {
    const double ratio =
        std::sqrt(core::variance(by(Scheme::kDirect, record, options).out) / core::variance(record));
    EXPECT_NEAR(ratio, 0.5, 0.02);
  }
}

TEST(RecordAnalysis, HasEverySchemesOutputBitForBit) {
  const Signal record = still_record(kMixedSize, 5);
  const RecordAnalysis analysis = core::analyse_record(record);
  for (const Scheme scheme : core::kAllSchemes)
    EXPECT_EQ(analysis.output(scheme), by(scheme, record).out) << core::name_of(scheme);
}

TEST(RecordAnalysis, AddsUpAndReportsAsTheDenoiserDoes) {
  const Signal record = still_record(kMixedSize, 6);
  const RecordAnalysis analysis = core::analyse_record(record);
  const core::WindowReport report = by(Scheme::kImproved, record).report;
  ASSERT_EQ(analysis.imfs.size(), report.imf_count);
  ASSERT_EQ(analysis.mixed.size(), report.k - report.j);
  ASSERT_FALSE(analysis.mixed.empty());
  Signal all = analysis.residue;
  for (const Signal& imf : analysis.imfs) all = sum(all, imf);
  EXPECT_LE(peak(sum(all, record, -1.0)), 1e-13);
  EXPECT_EQ(analysis.report.j, report.j);
  EXPECT_EQ(analysis.report.noise_floor, report.noise_floor);
  for (std::size_t i = report.j; i < report.k; ++i) {
    const core::ModelFigures& model = report.imf[i].model;
    const core::Identification& identified = analysis.mixed[i - report.j];
    EXPECT_EQ(analysis.report.imf[i].model.ar_coefficients, model.ar_coefficients);
    EXPECT_EQ(identified.model.family(), model.family);
    EXPECT_EQ(identified.residuals.adequate, model.adequate);
    EXPECT_EQ(identified.residuals.p_value, model.ljung_box_p);
    EXPECT_TRUE(model.tested);
  }
}

TEST(WholeRecord, KeepsTheMeanInEveryScheme) {
  const Signal record = still_record(kMixedSize, 7);
  for (const Scheme scheme : core::kAllSchemes)
    EXPECT_NEAR(core::mean(by(scheme, record).out), core::mean(record), 1e-14) << core::name_of(scheme);
}

// Motion: a swing of 5 deg/s at 0.1 Hz and one at 1 Hz, 100 Hz, noise 0.35 deg/s, 100 s. Its gain is the projection on the swing; the
// schemes that decompose keep it within 1 %, as the windowed one does (guard metrics).
TEST(WholeRecord, KeepsASlowSwingAtItsSize) {
  for (const double frequency : {0.001, 0.01}) {
    const Signal swing = times(tone(10000, frequency), 5.0);
    const Signal record = sum(swing, white_noise(10000, 8), 0.35);
    const RecordAnalysis analysis = core::analyse_record(record);
    for (const Scheme scheme : {Scheme::kEmd, Scheme::kImproved}) {
      double gain = 0.0;
      for (std::size_t n = 0; n < swing.size(); ++n) gain += analysis.output(scheme)[n] * swing[n];
      EXPECT_NEAR(gain / energy(swing), 1.0, 0.01) << core::name_of(scheme) << " at " << frequency;
    }
  }
}

TEST(RecordAnalysis, OfNextToNothingIsTheRecord) {
  for (const Signal& record : {Signal{}, Signal{1.0}, white_noise(15, 1), Signal(100, 2.0)}) {
    const RecordAnalysis analysis = core::analyse_record(record);
    EXPECT_TRUE(analysis.imfs.empty());
    EXPECT_TRUE(analysis.mixed.empty());
    for (const Scheme scheme : core::kAllSchemes) EXPECT_EQ(analysis.output(scheme), record);
  }
}

// Every model choice, rule and scheme stays finite on what no sensor gives.
TEST(WholeRecord, StaysFiniteOnHostileRecords) {
  Signal impulse(2000);
  impulse[700] = 1e6;
  Signal alternating(2000);
  for (std::size_t n = 0; n < alternating.size(); ++n) alternating[n] = n % 2 == 0 ? 1e-3 : -1e-3;
  for (const Signal& record : {impulse, alternating, tone(2000, 0.25), times(white_noise(2000, 1), 1e-150),
                               times(white_noise(2000, 2), 1e100), quantised(white_noise(2000, 3), 2.0)}) {
    const RecordAnalysis analysis = core::analyse_record(record);
    for (const Scheme scheme : core::kAllSchemes) EXPECT_TRUE(is_finite(analysis.output(scheme)));
  }
}

}  // namespace
}  // namespace gyrod
