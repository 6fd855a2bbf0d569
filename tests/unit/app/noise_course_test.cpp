// What is known of the noise in the course of a record, and what an evaluated method makes of it, against `gyrod denoise`.
#include "app/noise_course.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "app/angle_units.hpp"
#include "app/evaluated_methods.hpp"
#include "app/evaluation_noise.hpp"
#include "app/record_denoiser.hpp"
#include "support/low_passed.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr double kCourseRateHz = 100.0;
constexpr std::size_t kRest = 6000;
constexpr std::size_t kSwingsFrom = 3000;
constexpr std::size_t kWhole = 5000;

/// deg/s: half a minute at rest, then a swing of 5 deg/s; noise of 0.2 deg/s with a line at 20 Hz of seed 1, and elsewhere of others, which a guess takes for
/// motion.
Signal rest_then_swing(unsigned seed) {
  Signal rates = sum(times(white_noise(kWhole, seed), 0.16), tone(kWhole, 0.17 + 0.03 * seed), 0.16);
  for (std::size_t n = kSwingsFrom; n < kWhole; ++n)
    rates[n] += 5.0 * std::sin(0.02 * static_cast<double>(n - kSwingsFrom));
  return rates;
}

constexpr std::size_t kNever = 1'000'000;

std::size_t first_known(const app::NoiseCourse& course) {
  const auto first =
      std::ranges::find_if(course, [](const app::KnownNoise& known) { return core::is_usable(known.model); });
  return first == course.end() ? kNever : first->from_sample;
}

TEST(NoiseCourse, HoldsFromItsSampleUntilTheNext) {
  const app::NoiseCourse course = {{10, core::white_noise(1.0)}, {20, core::white_noise(4.0)}};
  EXPECT_FALSE(core::is_usable(app::known_at(course, 9)));
  EXPECT_EQ(app::known_at(course, 10).white_variance, 1.0);
  EXPECT_EQ(app::known_at(course, 19).white_variance, 1.0);
  EXPECT_EQ(app::known_at(course, 20).white_variance, 4.0);
  EXPECT_FALSE(core::is_usable(app::known_at({}, 20)));
  EXPECT_EQ(app::known_at(app::known_throughout(core::white_noise(9.0)), 0).white_variance, 9.0);
}

// The first models come after about 15 s. A minute gives a variance to 2 %; the margin of 2 % in level is 4 % in variance.
TEST(LearnedAtRest, IsTheNoiseOfEachAxis) {
  const Signal x = times(white_noise(kRest, 1), 0.1);
  const Signal z = times(white_noise(kRest, 3), 0.3);
  const auto courses = app::learned_from({x, {}, z}, kCourseRateHz);
  EXPECT_GT(first_known(courses[0]), 1000U);
  EXPECT_LT(first_known(courses[0]), 2500U);
  EXPECT_NEAR(core::noise_variance(courses[0].back().model), 1.04 * 0.01, 0.0008);
  EXPECT_NEAR(core::noise_variance(courses[2].back().model), 1.04 * 0.09, 0.0072);
  EXPECT_EQ(courses[1].back().model,
            courses[2].back().model);  // the strongest stands in for what is not there
}

TEST(LearnedAtRest, IsNothingWhereAnotherAxisMoves) {
  const Signal still = times(white_noise(kRest, 1), 0.1);
  const Signal moved = sum(still, tone(kRest, 0.003), 2.0);
  EXPECT_LT(first_known(app::learned_from({still, still, {}}, kCourseRateHz)[0]), kNever);
  EXPECT_EQ(first_known(app::learned_from({still, moved, {}}, kCourseRateHz)[0]), kNever);
}

/// What `gyrod denoise` makes of x, rad/s.
Signal published(app::EstimateKind kind, const std::array<Signal, 3>& rates_dps) {
  files::Record record;
  record.sample_rate_hz = kCourseRateHz;
  for (std::size_t n = 0; n < kWhole; ++n) {
    record.time_s.push_back(static_cast<double>(n) / kCourseRateHz);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!rates_dps[axis].empty()) record.gyro_radps[axis].push_back(app::kRadPerDeg * rates_dps[axis][n]);
    }
  }
  settings::Settings settings;
  settings.engine.sample_rate_hz = kCourseRateHz;
  return app::estimate_record(record, settings, kind)[0];
}

/// Largest difference between that and what is judged, deg/s.
double worst_difference(const Signal& published_radps, const char* name, const app::MethodContext& context,
                        const Signal& rates_dps) {
  const auto judged =
      app::evaluated_method({name, context.settings.engine.lag_samples}, context).run(rates_dps).estimate;
  double worst = 0.0;
  for (std::size_t t = 0; t < kWhole; ++t)
    worst = std::max(worst, std::abs(judged[t] - app::kDegPerRad * published_radps[t]));
  return worst;
}

TEST(LearnedAtRest, IsUsedFromTheSameSampleOnAsTheDaemonDoes) {
  const settings::Settings settings;
  const std::array<Signal, 3> rates = {rest_then_swing(1), rest_then_swing(2), rest_then_swing(3)};
  const auto courses = app::learned_from({rates[0], rates[1], rates[2]}, kCourseRateHz);
  const auto sensor = std::make_shared<app::SensorAxes>(app::SensorAxes{rates, courses});
  app::MethodContext learned{settings, kCourseRateHz, courses[0]};
  learned.sensor = sensor;
  const app::MethodContext guessing{settings, kCourseRateHz, {}};
  const Signal denoised = published(app::EstimateKind::kDenoised, rates);
  const Signal realtime = published(app::EstimateKind::kRealtime, rates);
  EXPECT_LT(worst_difference(denoised, "joint", learned, rates[0]), 1e-5);
  EXPECT_LT(worst_difference(realtime, "realtime", learned, rates[0]), 1e-5);
  EXPECT_GT(worst_difference(denoised, "joint", guessing, rates[0]), 0.05);
}

TEST(LearnedInMotion, IsToldFromWhatRestTeaches) {
  const auto measured = low_passed_motion(12'000, 1).measured;
  const auto courses = app::learned_from({measured[0], measured[1], measured[2]}, kLowPassedHz);
  app::RowNoise moved;
  app::add_learned(courses[0], moved);
  EXPECT_EQ(moved.by, app::NoiseKnownBy::kMotion);
  EXPECT_EQ(moved.from_sample, first_known(courses[0]));
  EXPECT_NEAR(static_cast<double>(first_known(courses[0])), 18.6 * kLowPassedHz, 0.1 * kLowPassedHz);
  const std::array<Signal, 3> rates = {rest_then_swing(1), rest_then_swing(2), rest_then_swing(3)};
  app::RowNoise rested;
  app::add_learned(app::learned_from({rates[0], rates[1], rates[2]}, kCourseRateHz)[0], rested);
  EXPECT_EQ(rested.by, app::NoiseKnownBy::kRest);
}

/// deg/s: a swing, and noise of 0.2 deg/s with, on one axis, a line of as much at 20 Hz.
std::array<Signal, 3> swing_with_a_line() {
  std::array<Signal, 3> rates;
  for (unsigned axis = 0; axis < 3; ++axis) {
    rates[axis] = sum(times(white_noise(kWhole, 60 + axis), 0.2), tone(kWhole, 0.002), 5.0);
  }
  const std::array<double, 2> line = {2.0 * 0.98 * std::cos(0.4 * std::numbers::pi), -0.98 * 0.98};
  rates[0] = sum(std::move(rates[0]), autoregressive(line, kWhole, 63), 0.06);
  return rates;
}

// From 44 s on.
TEST(LearnedInMotion, ALineIsUsedAsTheDaemonDoes) {
  const settings::Settings settings;
  const std::array<Signal, 3> rates = swing_with_a_line();
  const auto courses = app::learned_from({rates[0], rates[1], rates[2]}, kCourseRateHz);
  app::RowNoise row;
  app::add_learned(courses[0], row);
  EXPECT_EQ(row.by, app::NoiseKnownBy::kLines);
  EXPECT_FALSE(row.from_sample) << "the rest is guessed";
  const auto sensor = std::make_shared<app::SensorAxes>(app::SensorAxes{rates, courses});
  app::MethodContext learned{settings, kCourseRateHz, courses[0]};
  learned.sensor = sensor;
  const Signal denoised = published(app::EstimateKind::kDenoised, rates);
  EXPECT_LT(worst_difference(denoised, "joint", learned, rates[0]), 1e-5);
  app::MethodContext guessing{settings, kCourseRateHz, {}};
  guessing.sensor = std::make_shared<app::SensorAxes>(app::SensorAxes{rates, {}});
  EXPECT_GT(worst_difference(denoised, "joint", guessing, rates[0]), 0.05);
}

TEST(LearnedAtRest, IsWhatARunShowsItselfWhereItLearnsItself) {
  const settings::Settings settings;
  const std::array<Signal, 3> rates = {rest_then_swing(1), {}, {}};
  const app::MethodContext learning{settings, kCourseRateHz, {}, true};
  EXPECT_LT(worst_difference(published(app::EstimateKind::kDenoised, rates), "joint", learning, rates[0]),
            1e-6);
}

}  // namespace
}  // namespace gyrod
