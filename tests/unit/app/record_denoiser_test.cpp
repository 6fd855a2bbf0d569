// A record in memory against the engine row by row, and against the denoiser on the whole.
#include "app/record_denoiser.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "app/batch_denoiser.hpp"
#include "app/offline_denoiser.hpp"
#include "app/options.hpp"
#include "core/denoise/record_analysis.hpp"
#include "support/low_passed.hpp"
#include "support/signals.hpp"
#include "support/slow_build.hpp"

namespace gyrod {
namespace {

using core::Scheme;
using namespace testing;

/// Three windows long; under a sanitizer one and a half.
constexpr std::size_t kLong = testing::kSlowBuild ? 1500 : 3000;

/// A slow swing in noise, rad/s; y is missing where asked.
files::Record record_of(std::size_t size, bool with_y = true) {
  files::Record record;
  record.sample_rate_hz = 100.0;
  for (std::size_t n = 0; n < size; ++n) record.time_s.push_back(0.01 * static_cast<double>(n));
  for (unsigned axis = 0; axis < stream::kAxes; ++axis) {
    if (axis == 1 && !with_y) continue;
    record.gyro_radps[axis] = sum(times(tone(size, 0.003), 0.1), white_noise(size, axis + 1), 0.006);
  }
  return record;
}

struct Rows final : app::RowHandler {
  void on_denoised(const std::string& text, const std::array<double, stream::kAxes>& rates,
                   const std::array<double, stream::kAxes>& deviations) override {
    texts.push_back(text);
    x.push_back(rates[0]);
    x_deviation.push_back(deviations[0]);
  }
  void on_refused(const std::string& text) override { texts.push_back("refused " + text); }
  std::vector<std::string> texts;
  Signal x;
  Signal x_deviation;
};

files::RecordingRow row_of(const files::Record& record, std::size_t n) {
  files::RecordingRow row;
  row.text = "row " + std::to_string(n);
  row.sample.sequence = n;
  row.sample.stamp_ns = std::llround(static_cast<double>(n) * 1e9 / record.sample_rate_hz);
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    row.sample.rate_radps[axis] = record.gyro_radps[axis][n];
  return row;
}

template <class Denoiser>
void push_all(Denoiser& denoiser, const files::Record& record) {
  for (std::size_t n = 0; n < record.size(); ++n) {
    files::RecordingRow row = row_of(record, n);
    denoiser.push(row);
  }
  denoiser.finish();
}

TEST(DenoiseRecord, WindowedIsWhatTheOfflineDenoiserGives) {
  const files::Record record = record_of(kLong);
  for (const Scheme scheme : core::kAllSchemes) {
    settings::Settings settings;
    settings.denoise.method = settings::Method::kPaper;
    settings.denoise.scheme = scheme;
    Rows rows;
    app::DenoiseSummary summary;
    app::OfflineDenoiser denoiser(settings, rows, summary);
    push_all(denoiser, record);
    EXPECT_EQ(app::denoise_record(record, {}, scheme, false)[0], rows.x) << core::name_of(scheme);
  }
}

stream::NoiseReport reported(bool misfit, double noise_ratio) {
  stream::NoiseReport report;
  report.model_fit.emplace();
  (*report.model_fit)[1] = {.misfit = misfit, .wrong_noise = noise_ratio != 1.0, .noise_ratio = noise_ratio};
  return report;
}

// Of which axis, for how long, and what to do: a calibration that is wrong all the time is not one time wrong.
TEST(DenoiseSummary, SaysHowMuchOfTheTimeTheModelOfWhichAxisDoesNotFit) {
  app::DenoiseSummary fitting;
  fitting.add(reported(false, 1.0));
  EXPECT_TRUE(fitting.notes({}, {}).empty());
  app::DenoiseSummary unlikely;
  for (const bool misfit : {true, false, false, false}) unlikely.add(reported(misfit, 1.0));
  ASSERT_EQ(unlikely.notes({}, {}).size(), 1U);
  EXPECT_EQ(unlikely.notes({}, {})[0],
            "the model does not fit: y in 25 % of the windows; do not trust the deviations that are "
            "published there");
  app::DenoiseSummary wrong;
  for (const double ratio : {0.2, 0.4}) wrong.add(reported(true, ratio));
  ASSERT_EQ(wrong.notes({}, {}).size(), 1U);
  EXPECT_EQ(wrong.notes({}, {})[0],
            "the model does not fit: y in 100 % of the windows (noise of 0.3 times the deviation that is "
            "believed); "
            "calibrate the sensor again");
  EXPECT_NE(wrong.json({}, {}).find("\"misfit_share\": 1.0"), std::string::npos);
  app::DenoiseSummary hidden;
  stream::NoiseReport report = reported(true, 1.0);
  (*report.model_fit)[1].hidden_noise = true;
  hidden.add(report);
  ASSERT_EQ(hidden.notes({}, {}).size(), 1U);
  EXPECT_EQ(hidden.notes({}, {})[0],
            "the model does not fit: y in 100 % of the windows; nothing is known of the noise, and a "
            "low-pass of the sensor's own hides it: calibrate the sensor");
  hidden.add(reported(false, 1.0));
  EXPECT_EQ(hidden.notes({}, {})[0],
            "the model does not fit: y in 50 % of the windows; a low-pass of the sensor's own hid the noise "
            "until it was learned: calibrate the sensor");
}

// Before, nothing was taken off and the deviation was 1e-3 of the error. What is learned: HiddenNoiseLearner; 17 s.
TEST(DenoiseRecord, TakesOffNoiseThatALowPassOfTheSensorsOwnHides) {
  constexpr std::size_t kFrom = 10'000;
  constexpr std::size_t kSize = 14'000;
  constexpr double kRadPerDeg = 0.017453292519943295;
  const LowPassed sensor = low_passed_motion(kSize, 4);
  files::Record record;
  record.sample_rate_hz = kLowPassedHz;
  for (std::size_t n = 0; n < kSize; ++n) record.time_s.push_back(static_cast<double>(n) / kLowPassedHz);
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    record.gyro_radps[axis] = times(sensor.measured[axis], kRadPerDeg);
  Rows rows;
  app::DenoiseSummary summary;
  app::OfflineDenoiser denoiser({}, rows, summary, {.estimate = app::EstimateKind::kDenoised});
  push_all(denoiser, record);
  ASSERT_EQ(rows.x.size(), kSize);
  double raw = 0.0;
  double left = 0.0;
  double claimed = 0.0;
  for (std::size_t n = kFrom; n < kSize; ++n) {
    const double truth = kRadPerDeg * sensor.truth[0][n];
    raw += std::pow(record.gyro_radps[0][n] - truth, 2.0);
    left += std::pow(rows.x[n] - truth, 2.0);
    claimed += std::pow(rows.x_deviation[n], 2.0);
  }
  EXPECT_LT(left, 0.3 * raw);
  EXPECT_NEAR(left / claimed, 1.0, 0.5);
}

TEST(DenoiseRecord, EstimatesAreWhatTheOfflineDenoiserGives) {
  const files::Record record = record_of(kLong);
  for (const auto kind : {app::EstimateKind::kDenoised, app::EstimateKind::kRealtime}) {
    Rows rows;
    app::DenoiseSummary summary;
    app::OfflineDenoiser denoiser({}, rows, summary, {.estimate = kind});
    push_all(denoiser, record);
    EXPECT_EQ(app::estimate_record(record, {}, kind)[0], rows.x);
  }
}

TEST(DenoiseRecord, WholeIsWhatTheDenoiserGivesForOneWindow) {
  const files::Record record = record_of(5000);
  for (const Scheme scheme : core::kAllSchemes) {
    core::DenoiserOptions options = core::whole_record_options(app::denoiser_options({}));
    options.scheme = scheme;
    Signal expected(record.size());
    core::WindowReport report;
    core::Denoiser(record.size(), options).denoise(record.gyro_radps[2], expected, report);
    EXPECT_EQ(app::denoise_record(record, {}, scheme, true)[2], expected) << core::name_of(scheme);
  }
}

TEST(DenoiseRecord, LeavesAMissingAxisEmptyAndAShortRecordAsItIs) {
  for (const bool whole : {false, true}) {
    const auto denoised = app::denoise_record(record_of(2000, false), {}, Scheme::kImproved, whole);
    EXPECT_EQ(denoised[0].size(), 2000U);
    EXPECT_TRUE(denoised[1].empty());
    const files::Record shortest = record_of(9);
    EXPECT_EQ(app::denoise_record(shortest, {}, Scheme::kImproved, whole), shortest.gyro_radps);
  }
}

// Rows 100 and 4000 are refused, 200 to 204 and 2000 to 2999 are not there: two stretches, the first with a bridge of 5 and a refused
// row among its samples.
TEST(BatchDenoiser, KeepsEveryRowInOrderAndStretchesApart) {
  const files::Record record = record_of(5000);
  Rows rows;
  app::DenoiseSummary summary;
  core::DenoiserOptions options = core::whole_record_options();
  app::BatchDenoiser denoiser({}, options, rows, summary, [] { return true; });
  std::vector<std::string> expected;
  for (std::size_t n = 0; n < record.size(); ++n) {
    if ((n >= 200 && n < 205) || (n >= 2000 && n < 3000)) continue;
    files::RecordingRow row = row_of(record, n);
    const bool bad = n == 100 || n == 4000;
    if (bad) row.sample.rate_radps[1] = std::nan("");
    expected.push_back((bad ? "refused " : "") + row.text);
    denoiser.push(row);
  }
  denoiser.finish();
  EXPECT_EQ(rows.texts, expected);
  const stream::Counts& counts = denoiser.counts();
  EXPECT_EQ(counts.received, 3995U);
  EXPECT_EQ(counts.rejected_total(), 2U);
  EXPECT_EQ(counts.published, 3993U);
  EXPECT_EQ(counts.bridged, 7U) << "5 missing and 2 refused";
  EXPECT_EQ(counts.gaps, 1U);
  EXPECT_EQ(counts.windows, 2U);

  // The second stretch by itself, with its refused sample bridged.
  Signal second(record.gyro_radps[0].begin() + 3000, record.gyro_radps[0].end());
  second[1000] = 0.5 * (second[999] + second[1001]);
  Signal out(second.size());
  core::WindowReport report;
  core::Denoiser(second.size(), options).denoise(second, out, report);
  out.erase(out.begin() + 1000);
  EXPECT_EQ(Signal(rows.x.end() - 1999, rows.x.end()), out);
}

}  // namespace
}  // namespace gyrod
