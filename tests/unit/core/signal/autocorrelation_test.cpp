// The ACF by transforms against its definition.
#include "core/signal/autocorrelation.hpp"

#include <gtest/gtest.h>

#include "core/signal/moments.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using core::Autocorrelation;
using namespace testing;

/// [Yang2019] eq. (3) as it stands.
Signal acf_by_definition(const Signal& x) {
  const Signal z = sum(x, Signal(x.size(), core::mean(x)), -1.0);
  Signal rho(x.size());
  for (std::size_t lag = 0; lag < x.size(); ++lag) {
    for (std::size_t n = 0; n + lag < x.size(); ++n) {
      rho[lag] += z[n] * z[n + lag];
    }
  }
  return times(rho, 1.0 / energy(z));
}

/// Noise, a tone, a step and an impulse with an offset, from 2 samples on and around powers of two.
std::vector<Signal> signals() {
  std::vector<Signal> all;
  for (const std::size_t size : {2U, 3U, 5U, 16U, 17U, 127U, 128U, 129U, 1000U, 1024U}) {
    Signal impulse(size, -3.0);
    impulse.back() = 1.0;
    Signal step(size, 0.0);
    std::fill_n(step.begin(), size / 2, 1.0);
    all.insert(all.end(), {white_noise(size, 1), sum(tone(size, 0.03), Signal(size, 5.0)), step, impulse});
  }
  return all;
}

// |rho| <= 1; transforms of 2048 points round at about eleven times 1e-16.
TEST(Autocorrelation, ByTransformsEqualsTheDirectSum) {
  for (const Signal& x : signals()) {
    Autocorrelation autocorrelation(1024);
    Signal rho(x.size());
    autocorrelation.acf(x, rho);
    EXPECT_LE(peak(sum(rho, acf_by_definition(x), -1.0)), 2e-14) << x.size();
    EXPECT_EQ(rho[0], 1.0);
  }
}

TEST(Autocorrelation, OfFewLagsIsTheStartOfThatOfAll) {
  const Signal x = white_noise(300, 2);
  Autocorrelation autocorrelation(300);
  Signal all(300);
  Signal few(7);
  autocorrelation.acf(x, all);
  autocorrelation.acf(x, few);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
}

// By Parseval from the spectrum against the variance of rho_0..rho_(N-1), lag by lag.
TEST(AcfVariance, EqualsTheVarianceOverAllLags) {
  for (const Signal& x : signals()) {
    Autocorrelation autocorrelation(1024);
    const double direct = core::variance(acf_by_definition(x));
    EXPECT_NEAR(autocorrelation.acf_variance(x), direct, 1e-13 * std::max(direct, 1e-3)) << x.size();
  }
}

TEST(AcfVariance, DoesNotDependOnScaleOrOffset) {
  const Signal x = white_noise(512, 3);
  Autocorrelation autocorrelation(512);
  const double expected = autocorrelation.acf_variance(x);
  EXPECT_EQ(autocorrelation.acf_variance(times(x, 0x1p-200)), expected);
  EXPECT_NEAR(autocorrelation.acf_variance(sum(x, Signal(512, 10.0))), expected, 1e-12 * expected);
}

// Of white noise sum rho_l^2 over l >= 1 is about (N-1)/2 / N: the variance is 1.5 / N. 3 % is 4 standard
// errors.
TEST(AcfVariance, OfWhiteNoiseIsThreeHalvesOverItsLength) {
  constexpr std::size_t kSize = 1024;
  constexpr unsigned kSeeds = 200;
  Autocorrelation autocorrelation(kSize);
  double mean = 0.0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    mean += autocorrelation.acf_variance(white_noise(kSize, seed)) / kSeeds;
  }
  EXPECT_NEAR(mean * kSize, 1.5, 0.045);
}

TEST(Autocorrelation, OfAConstantIsOneAndThenZero) {
  for (const double level : {0.0, 0.1, -3.0, 1e300}) {
    Autocorrelation autocorrelation(10);
    const Signal constant(10, level);
    Signal rho(10, 42.0);
    autocorrelation.acf(constant, rho);
    EXPECT_EQ(rho, (Signal{1, 0, 0, 0, 0, 0, 0, 0, 0, 0})) << level;
    EXPECT_EQ(autocorrelation.acf_variance(constant), 0.0) << level;
  }
}

TEST(Autocorrelation, OfOneSampleIsOne) {
  Autocorrelation autocorrelation(1);
  Signal rho(1);
  autocorrelation.acf(Signal{2.0}, rho);
  EXPECT_EQ(rho[0], 1.0);
  EXPECT_EQ(autocorrelation.acf_variance(Signal{2.0}), 0.0);
}

TEST(Autocorrelation, OfAShorterSeriesDoesNotSeeALongerOneBeforeIt) {
  Autocorrelation used(1000);
  Autocorrelation fresh(1000);
  static_cast<void>(used.acf_variance(white_noise(1000, 4)));
  EXPECT_EQ(used.acf_variance(white_noise(100, 5)), fresh.acf_variance(white_noise(100, 5)));
}

}  // namespace
}  // namespace gyrod
