#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "report/comparison_section.hpp"
#include "unit/report/noise.hpp"

namespace gyrod::report {
namespace {

TEST(Snr, OfAStillRecordIsItsConstantRateOverTheRest) {
  // 0.5 +- 0.05: 20 log10(10) = 20 dB.
  const std::vector<double> output = {0.55, 0.45, 0.55, 0.45};
  EXPECT_NEAR(*snr_db(output, {{}, 0.5, 0.5}), 20.0, 1e-9);
}

TEST(Snr, AnOutputOfZerosHasNoneByEitherRule) {
  const std::vector<double> zeros(100, 0.0);
  EXPECT_NEAR(*snr_db(zeros, {{}, 0.5, 0.5}), 0.0, 1e-9);
  const auto truth = testing::white_noise(100, 2.0, 5, 3.0);
  double mean = 0.0;
  for (const double x : truth) mean += x / 100.0;
  double variance = 0.0;
  for (const double x : truth) variance += (x - mean) * (x - mean) / 100.0;
  EXPECT_NEAR(*snr_db(zeros, {truth, 0.0, std::sqrt(variance)}), 0.0, 1e-9);
}

TEST(Snr, AConstantErrorAgainstTheTruthDoesNotCountAndUnknownTruthIsLeftOut) {
  const std::vector<double> truth = {1.0, -1.0, 1.0, -1.0, std::nan("")};
  const std::vector<double> output = {3.1, 0.9, 2.9, 1.1, 1e9};  // truth + 2 +- 0.1
  EXPECT_NEAR(*snr_db(output, {truth, 0.0, 1.0}), 20.0, 1e-9);
}

TEST(Snr, IsNotThereWithoutSignalOrWithoutNoise) {
  const std::vector<double> output = {0.5, 0.5};
  EXPECT_FALSE(snr_db(output, {{}, 0.5, 0.5}));
  EXPECT_FALSE(snr_db(output, {{}, 0.0, 0.0}));
}

/// An analysis in which every scheme's output is a share of the record's noise.
core::RecordAnalysis analysis_of(const std::vector<double>& record) {
  core::RecordAnalysis analysis;
  for (std::size_t s = 0; s < core::kSchemes; ++s) {
    analysis.outputs[s] = record;
    for (double& x : analysis.outputs[s]) x /= static_cast<double>(s + 1);
  }
  return analysis;
}

TEST(Table5, MeanAbsoluteDeviationOfGaussianNoiseIs798ThousandthsOfItsStandardDeviation) {
  // E|x| = sqrt(2/pi) sigma; 4 standard errors of 100 000 samples are 0.8 %.
  const core::RecordAnalysis analysis = analysis_of(testing::white_noise(100'000, 0.01, 6, 0.002));
  const Json table = table5_section({"x", 100.0, true, {}, analysis});
  const Json& raw = table.at("rows").at(0);
  EXPECT_NEAR(raw.at("mean_absolute_deviation_dps").get<double>() / raw.at("std_dps").get<double>(), 0.798,
              0.006);
  EXPECT_NEAR(raw.at("std_dps").get<double>(), 0.01 * kDegPerRad, 0.01 * kDegPerRad * 0.01);
}

TEST(Table5, ThePapersNumbersStandBesideAStillRecordOnly) {
  const core::RecordAnalysis analysis = analysis_of(testing::white_noise(1000, 0.01, 7, 0.002));
  const Json still = table5_section({"x", 100.0, true, {}, analysis});
  EXPECT_EQ(still.at("paper").at("improved").at("std_dps"), 0.0915);
  EXPECT_FALSE(still.contains("snr_absent"));
  const Json moving = table5_section({"x", 100.0, false, {}, analysis});
  EXPECT_FALSE(moving.contains("paper"));
  EXPECT_TRUE(moving.contains("snr_absent"));
  EXPECT_TRUE(moving.at("rows").at(0).at("snr_db").is_null());
}

}  // namespace
}  // namespace gyrod::report
