// Coefficients of simulated noise, whose truth is known, over many seeds.
#include <gtest/gtest.h>

#include "allan_support.hpp"
#include "core/simulation/gyro_errors.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::fit_coefficients;
using core::NoiseCoefficients;

constexpr double kRate = 100.0;

Signal simulated(const core::GyroErrorOptions& options, std::size_t samples, std::uint64_t seed) {
  core::GyroErrors errors(options, kRate, seed);
  Signal rate(samples);
  for (double& value : rate) value = errors.measure(0.0);
  return rate;
}

core::GyroErrorOptions noise(double white, double bias, double walk) {
  core::GyroErrorOptions options = core::no_gyro_errors();
  options.white_noise_density = white;
  options.bias_instability_radps = bias;
  options.rate_random_walk = walk;
  return options;
}

/// How often a term was observable, and how often the truth lay within two standard errors then.
struct Tally {
  int seen = 0;
  int held = 0;

  void count(const core::Coefficient& found, double truth) {
    if (!found.observable) return;
    ++seen;
    if (std::abs(found.value - truth) <= 2.0 * found.standard_error) ++held;
  }
};

TEST(CoefficientRecovery, OnWhiteNoiseOnlyTheWhiteNoiseIsObservable) {
  constexpr double kTruth = 1e-3;
  int only_white = 0;
  Tally white;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const auto rate = simulated(noise(kTruth, 0.0, 0.0), 20'000, seed);
    const NoiseCoefficients found = fit_coefficients(core::allan_deviation(rate, kRate));
    white.count(found[kN], kTruth);
    const bool others =
        found[kQ].observable || found[kB].observable || found[kK].observable || found[kR].observable;
    if (!others) ++only_white;
  }
  EXPECT_EQ(white.seen, 100);
  EXPECT_GE(white.held, 95);
  EXPECT_GE(only_white, 95);  // 99 with records of 100 000 samples
}

// An hour of a MEMS gyro each. Two standard errors hold the truth in 95 % of cases if they are right; 11 of 15 is
// four standard deviations below that.
TEST(CoefficientRecovery, WhiteNoiseAndBiasInstability) {
  Tally white;
  Tally bias;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const auto rate = simulated(noise(7e-4, 4e-4, 0.0), 360'000, seed);
    const NoiseCoefficients found = fit_coefficients(core::allan_deviation(rate, kRate));
    white.count(found[kN], 7e-4);
    bias.count(found[kB], 4e-4);
  }
  EXPECT_EQ(white.seen, 15);
  EXPECT_GE(white.held, 11);
  EXPECT_GE(bias.seen, 14);
  EXPECT_GE(bias.held, 11);
}

TEST(CoefficientRecovery, WhiteNoiseAndRateRandomWalk) {
  Tally white;
  Tally walk;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    const auto rate = simulated(noise(7e-4, 0.0, 4e-5), 360'000, seed);
    const NoiseCoefficients found = fit_coefficients(core::allan_deviation(rate, kRate));
    white.count(found[kN], 7e-4);
    walk.count(found[kK], 4e-5);
  }
  EXPECT_EQ(white.seen, 15);
  EXPECT_GE(white.held, 11);
  EXPECT_GE(walk.seen, 14);
  EXPECT_GE(walk.held, 11);
}

TEST(CoefficientRecovery, QuantizationAndRamp) {
  Tally quantization;
  Tally ramp;
  for (unsigned seed = 1; seed <= 15; ++seed) {
    Signal rate = sum(simulated(noise(7e-4, 0.0, 0.0), 360'000, seed),
                      times(differenced_noise(360'000, seed), kRate), 4e-5);
    for (std::size_t n = 0; n < rate.size(); ++n) rate[n] += 1e-6 / kRate * static_cast<double>(n);
    const NoiseCoefficients found = fit_coefficients(core::allan_deviation(rate, kRate));
    quantization.count(found[kQ], 4e-5);
    ramp.count(found[kR], 1e-6);
  }
  EXPECT_EQ(quantization.seen, 15);
  EXPECT_GE(quantization.held, 11);
  EXPECT_EQ(ramp.seen, 15);
  EXPECT_GE(ramp.held, 11);
}

}  // namespace
}  // namespace gyrod
