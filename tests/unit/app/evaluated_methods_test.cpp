// What `gyrod evaluate` judges, against what `gyrod denoise` gives.
#include "app/evaluated_methods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "app/angle_units.hpp"
#include "app/record_denoiser.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr double kJudgedRateHz = 100.0;
constexpr double kFastRateHz = 500.0;  // windows and hops of method joint are four times as long

/// deg/s: a slow swing and vibration at 20 Hz, in noise.
Signal shaken(std::size_t size) {
  return sum(sum(times(tone(size, 0.003), 5.0), tone(size, 0.2)), white_noise(size, 7), 0.1);
}

std::vector<double> judged(const char* name, const settings::Settings& settings, const Signal& noisy,
                           double rate_hz = kJudgedRateHz) {
  return app::evaluated_method({name, settings.engine.lag_samples}, {settings, rate_hz, {}})
      .run(noisy)
      .estimate;
}

/// Root mean square of what an estimate has of the vibration, from sample 2000 on.
double vibration_of(const std::vector<double>& estimate) {
  const Signal slow = times(tone(estimate.size(), 0.003), 5.0);
  double sum = 0.0;
  for (std::size_t t = 2000; t < estimate.size(); ++t)
    sum += (estimate[t] - slow[t]) * (estimate[t] - slow[t]);
  return std::sqrt(sum / static_cast<double>(estimate.size() - 2000));
}

// 0.71 deg/s as measured; 20 Hz lie twice as high as the band.
TEST(EvaluatedMethods, TakeOffWhatIsFasterThanTheConfiguredBand) {
  const Signal noisy = shaken(6000);
  settings::Settings settings;
  EXPECT_GT(vibration_of(judged("joint", settings, noisy)), 0.6);
  settings.denoise.max_signal_hz = 10.0;
  EXPECT_LT(vibration_of(judged("joint", settings, noisy)), 0.2);
  EXPECT_LT(vibration_of(judged("realtime", settings, noisy)), 0.4);
}

// The engine finds the sample rate after its first window, the contender is told. A minute later both have the same models, but for what of that is
// remembered, and for rounding: one counts in rad/s, the other in deg/s, and gains of slow motion far above the noise are known to some 1e-5.
class EvaluatedAtRate : public ::testing::TestWithParam<double> {};

TEST_P(EvaluatedAtRate, IsWhatDenoiseGivesWithTheSameConfiguration) {
  const double rate_hz = GetParam();
  const auto remembers = static_cast<std::size_t>(60.0 * rate_hz);
  const Signal noisy = shaken(remembers + 1000);
  settings::Settings settings;
  settings.denoise.max_signal_hz = 10.0;
  settings.denoise.sifts = 6;
  settings.engine.hop_samples = 64;
  settings.engine.lag_samples = 8;
  files::Record record;
  record.sample_rate_hz = rate_hz;
  for (std::size_t n = 0; n < noisy.size(); ++n) {
    record.time_s.push_back(static_cast<double>(n) / rate_hz);
    record.gyro_radps[2].push_back(app::kRadPerDeg * noisy[n]);
  }
  const auto denoised = app::estimate_record(record, settings, app::EstimateKind::kDenoised)[2];
  const auto estimate = judged("joint", settings, noisy, rate_hz);
  double worst = 0.0;
  for (std::size_t t = remembers; t < noisy.size(); ++t)
    worst = std::max(worst, std::abs(estimate[t] - app::kDegPerRad * denoised[t]));
  EXPECT_LT(worst, 1e-4);
}

/// Of three axes, from sample 0 on, what is judged and what `gyrod denoise` gives, deg/s: the largest difference.
double worst_of(const std::array<Signal, 3>& noisy, const settings::Settings& settings,
                const app::MethodContext& context) {
  files::Record record;
  record.sample_rate_hz = kJudgedRateHz;
  for (std::size_t n = 0; n < noisy[0].size(); ++n) {
    record.time_s.push_back(static_cast<double>(n) / kJudgedRateHz);
    for (std::size_t axis = 0; axis < 3; ++axis)
      record.gyro_radps[axis].push_back(app::kRadPerDeg * noisy[axis][n]);
  }
  const auto denoised = app::estimate_record(record, settings, app::EstimateKind::kDenoised);
  double worst = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    app::MethodContext of_axis = context;
    of_axis.axis = axis;
    if (of_axis.sensor) of_axis.noise = of_axis.sensor->noise[axis];
    const auto estimate =
        app::evaluated_method({"joint", settings.engine.lag_samples}, of_axis).run(noisy[axis]).estimate;
    for (std::size_t t = 0; t < estimate.size(); ++t)
      worst = std::max(worst, std::abs(estimate[t] - app::kDegPerRad * denoised[axis][t]));
  }
  return worst;
}

// A body that shakes about a slanted axis, from the first sample on. Where nothing is known, its shaking is taken for noise by whoever sees one axis.
TEST(EvaluatedMethods, SeeWhatAxesShareAsTheDaemonDoes) {
  const Signal shaking = white_noise(3000, 5);
  std::array<Signal, 3> noisy;
  for (std::size_t axis = 0; axis < 3; ++axis)
    noisy[axis] =
        sum(times(shaking, 1.0 + static_cast<double>(axis)),
            white_noise(3000, 11 + static_cast<unsigned>(axis)), 0.1 * (1.0 + static_cast<double>(axis)));
  settings::Settings settings;
  settings.engine.sample_rate_hz = kJudgedRateHz;
  settings.noise.source = settings::NoiseSource::kImf1;
  app::MethodContext context{settings, kJudgedRateHz, {}};
  EXPECT_GT(worst_of(noisy, settings, context), 1.0);
  context.sensor = std::make_shared<app::SensorAxes>(app::SensorAxes{noisy, {}});
  EXPECT_LT(worst_of(noisy, settings, context), 1e-6);
}

// One pass gives what each gives by itself, and the record with something on top is another.
TEST(EvaluatedMethods, ShareTheirModelsWithoutATrace) {
  const Signal noisy = shaken(1500);
  const Signal other = times(noisy, 2.0);
  const settings::Settings settings;
  const app::MethodContext context{settings, kJudgedRateHz, {}};
  const std::vector<app::WantedMethod> wanted = {
      {"joint", 0}, {"improved", 8}, {"joint", 32}, {"realtime", 16}};
  const auto together = app::evaluated_methods(wanted, context, 2);
  ASSERT_EQ(together.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const core::Method alone = app::evaluated_method(wanted[i], context);
    EXPECT_EQ(together[i].name, wanted[i].name);
    EXPECT_EQ(together[i].lag_samples, alone.lag_samples);
    for (const Signal& record : {noisy, other, noisy}) {
      const core::Contender contender = together[i].run(record);
      const core::Contender expected = alone.run(record);
      EXPECT_EQ(contender.name, wanted[i].name);
      EXPECT_EQ(contender.lag_samples, alone.lag_samples);
      EXPECT_EQ(contender.estimate, expected.estimate) << i;
      EXPECT_EQ(contender.std, expected.std) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EvaluatedMethods, EvaluatedAtRate, ::testing::Values(kJudgedRateHz, kFastRateHz));

}  // namespace
}  // namespace gyrod
