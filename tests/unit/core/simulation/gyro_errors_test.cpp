/// Each error term against its closed form.
#include "core/simulation/gyro_errors.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "unit/core/simulation/simulation_support.hpp"

namespace gyrod::core {
namespace {

using test::allan_deviation;
using test::mean_of;
using test::standard_deviation_of;
using test::still_record;

/// sqrt(2 ln 2 / pi): Allan deviation of flicker noise over B.
const double kFlickerFloor = std::sqrt(2.0 * std::numbers::ln2 / std::numbers::pi);

GyroErrorOptions only_white(double density) {
  GyroErrorOptions options = no_gyro_errors();
  options.white_noise_density = density;
  return options;
}

TEST(GyroErrors, WithoutErrorsTheTruthIsMeasured) {
  GyroErrors errors(no_gyro_errors(), 100.0, 1);
  for (const double truth : {0.0, -1.0, 0.1, 1e6}) EXPECT_EQ(errors.measure(truth), truth);
}

TEST(GyroErrors, WhiteNoiseHasItsDensityTimesTheRootOfTheSampleRate) {
  constexpr double kDensity = 6.1e-4;
  constexpr std::size_t kSamples = 200'000;
  for (const double rate_hz : {1.0, 100.0, 4000.0}) {
    const auto record = still_record(only_white(kDensity), rate_hz, kSamples, 3);
    const double expected = kDensity * std::sqrt(rate_hz);
    // Standard error of a standard deviation: 1 / sqrt(2 n) = 0.16 %; four of them.
    EXPECT_NEAR(standard_deviation_of(record) / expected, 1.0, 0.0064) << rate_hz;
    EXPECT_NEAR(mean_of(record) / expected, 0.0, 4.0 / std::sqrt(static_cast<double>(kSamples))) << rate_hz;
  }
}

TEST(GyroErrors, DefaultsAreThoseOfTheDataSheet) {
  // 2.1 deg/sqrt(h) = 2.1 / 60 deg/sqrt(s): 0.35 deg/s at 100 Hz.
  EXPECT_NEAR(GyroErrorOptions{}.white_noise_density * 10.0, 0.35 * std::numbers::pi / 180.0, 1e-12);
}

TEST(GyroErrors, AllanDeviationIsThatOfWhiteNoiseAndTheFlickerFloor) {
  constexpr double kRateHz = 50.0;
  constexpr std::size_t kSamples = 2'000'000;
  GyroErrorOptions options = only_white(1e-4);
  options.bias_instability_radps = 1e-4;
  const auto record = still_record(options, kRateHz, kSamples, 5);
  for (const double tau_s : {1.0, 3.0, 10.0, 30.0, 100.0}) {
    const double floor = kFlickerFloor * options.bias_instability_radps;
    const double expected = std::hypot(options.white_noise_density / std::sqrt(tau_s), floor);
    const double measured = allan_deviation(record, kRateHz, static_cast<std::size_t>(tau_s * kRateHz));
    // 400 independent clusters at 100 s: a standard error of some 5 %; three of them.
    EXPECT_NEAR(measured / expected, 1.0, 0.15) << tau_s << " s";
  }
}

TEST(GyroErrors, RateRandomWalkRisesWithTheRootOfTau) {
  constexpr double kRateHz = 10.0;
  constexpr std::size_t kSamples = 1'000'000;
  GyroErrorOptions options = no_gyro_errors();
  options.rate_random_walk = 1e-4;
  const auto record = still_record(options, kRateHz, kSamples, 7);
  EXPECT_EQ(record[0], 0.0) << "starts at 0";
  for (const double tau_s : {10.0, 30.0, 100.0}) {
    const double expected = options.rate_random_walk * std::sqrt(tau_s / 3.0);
    const double measured = allan_deviation(record, kRateHz, static_cast<std::size_t>(tau_s * kRateHz));
    // 1000 independent clusters at 100 s: a standard error of some 3 %; four of them.
    EXPECT_NEAR(measured / expected, 1.0, 0.12) << tau_s << " s";
  }
}

TEST(GyroErrors, EveryRecordHasABiasOfItsOwnFromFlicker) {
  constexpr std::size_t kRecords = 2000;
  GyroErrorOptions options = no_gyro_errors();
  options.bias_instability_radps = 1e-4;
  std::vector<double> first(kRecords);
  for (std::size_t seed = 0; seed < kRecords; ++seed)
    first[seed] = GyroErrors(options, 100.0, seed).measure(0.0);
  // Six stages of variance (ln 10 / pi) B^2: 2.0971 B. Four standard errors of 1.6 %.
  EXPECT_NEAR(standard_deviation_of(first) / options.bias_instability_radps, 2.0971, 0.13);
}

TEST(GyroErrors, MeasuredRatesAreTheNearestMultiplesOfTheStep) {
  GyroErrorOptions options = no_gyro_errors();
  options.step_radps = 0.0125;
  GyroErrors errors(options, 100.0, 1);
  for (double truth = -1.0; truth < 1.0; truth += 0.000'317) {
    const double measured = errors.measure(truth);
    const double steps = measured / options.step_radps;
    EXPECT_NEAR(steps, std::round(steps), 1e-12) << truth;  // rounding of the division
    EXPECT_LE(std::abs(measured - truth), options.step_radps / 2.0 * (1.0 + 1e-12)) << truth;
  }
}

TEST(GyroErrors, RatesBeyondTheRangeSaturate) {
  GyroErrorOptions options = no_gyro_errors();
  options.range_radps = 5.0;
  GyroErrors errors(options, 100.0, 1);
  EXPECT_EQ(errors.measure(7.0), 5.0);
  EXPECT_EQ(errors.measure(-1e9), -5.0);
  EXPECT_EQ(errors.measure(4.75), 4.75);
}

TEST(GyroErrors, ABiasIsAdded) {
  GyroErrorOptions options = no_gyro_errors();
  options.bias_radps = -0.25;
  EXPECT_EQ(GyroErrors(options, 100.0, 1).measure(1.0), 0.75);
}

}  // namespace
}  // namespace gyrod::core
