#include "core/joint/recency_tapers.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;
using testing::white_noise;

/// The taper itself from the definition, t_k(i) = sin(pi k phi(u)) sqrt(phi'(u)), to unit energy.
Signal taper(std::size_t n, double k, double recency) {
  Signal t(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(n);
    const double phi = (std::exp(recency * u) - 1.0) / (std::exp(recency) - 1.0);
    t[i] = std::sin(std::numbers::pi * k * phi) * std::exp(0.5 * recency * u);
  }
  return testing::times(t, 1.0 / std::sqrt(testing::energy(t)));
}

/// sum_i t(i) x(i) t(i+lag) x(i+lag), the mean over tapers 1..tapers.
double autocovariance_by_definition(const Signal& x, std::size_t lag, int tapers, double recency) {
  double sum = 0.0;
  for (int k = 1; k <= tapers; ++k) {
    const Signal t = taper(x.size(), k, recency);
    for (std::size_t i = 0; i + lag < x.size(); ++i) sum += t[i] * x[i] * t[i + lag] * x[i + lag];
  }
  return sum / tapers;
}

// The warp keeps sine tapers orthogonal: with v = phi(u) the sum is that of sin(pi j v) sin(pi k v) dv, up to the midpoint rule, whose
// error at n = 1024 is below 1e-4.
TEST(RecencyTapers, AreOrthogonal) {
  constexpr std::size_t kSize = 1024;
  for (double j = 1.0; j <= 4.0; ++j) {
    for (double k = 1.0; k < j; ++k) {
      const Signal a = taper(kSize, j, 4.0);
      const Signal b = taper(kSize, k, 4.0);
      EXPECT_NEAR(std::inner_product(a.begin(), a.end(), b.begin(), 0.0), 0.0, 1e-4) << j << " " << k;
    }
  }
}

// An impulse at i has the periodogram t_1(i)^2 at every frequency: that shows the tapers the class has.
TEST(RecencyTapers, AreThoseOfTheDefinition) {
  constexpr std::size_t kSize = 300;
  RecencyTapers tapers(kSize, 1, 4.0);
  const Signal expected = taper(kSize, 1.0, 4.0);
  Signal power(tapers.bins());
  for (const std::size_t i : {0U, 100U, 250U, 299U}) {
    Signal impulse(kSize);
    impulse[i] = 1.0;
    tapers.spectrum(impulse, power);
    for (const double value : power) EXPECT_NEAR(value, expected[i] * expected[i], 1e-15);
  }
}

// The mean of a periodogram over the whole circle is the energy of what was tapered, and so the autocovariance at lag 0 (Parseval).
TEST(RecencyTapers, SpectrumAndAutocovarianceAgree) {
  const Signal x = white_noise(1000, 1);
  RecencyTapers tapers(1000, 2, 4.0);
  Signal power(tapers.bins());
  tapers.spectrum(x, power);
  double sum = power.front() + power.back();
  for (std::size_t k = 1; k + 1 < power.size(); ++k) sum += 2.0 * power[k];
  std::array<double, 1> r{};
  tapers.autocovariance(x, r);
  EXPECT_NEAR(sum / static_cast<double>(tapers.transform_samples()), r[0], 1e-12);
}

TEST(RecencyTapers, AutocovarianceIsTheSumInTime) {
  for (const std::size_t size : {64U, 701U, 1024U}) {
    const Signal x = white_noise(size, 2);
    RecencyTapers tapers(1024, 2, 4.0);
    std::array<double, 4> r{};
    tapers.autocovariance(x, r);
    for (std::size_t lag = 0; lag < r.size(); ++lag) {
      EXPECT_NEAR(r[lag], autocovariance_by_definition(x, lag, 2, 4.0), 1e-13) << size << " " << lag;
    }
  }
}

// White noise of variance s^2 has s^2 at every frequency on average. 200 spectra of 513 bins, of which two tapers leave each bin about
// two degrees of freedom and neighbours alike: 1 % is three of the mean's deviations.
TEST(RecencyTapers, WhiteNoiseHasItsVarianceAsMeanSpectrum) {
  RecencyTapers tapers(1024, 2, 4.0);
  for (const auto spectrum : {&RecencyTapers::spectrum, &RecencyTapers::prewhitened_spectrum}) {
    Signal power(tapers.bins());
    double sum = 0.0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      (tapers.*spectrum)(testing::times(white_noise(1024, seed), 3.0), power);
      sum += std::accumulate(power.begin(), power.end(), 0.0) / static_cast<double>(power.size());
    }
    EXPECT_NEAR(sum / 200.0, 9.0, 0.09 * 2.0);
  }
}

double mean_of(std::span<const double> power) {
  return std::accumulate(power.begin(), power.end(), 0.0) / static_cast<double>(power.size());
}

// Motion of 1.3 periods a window, 57 dB above the noise's variance of 1. Means over 20 windows and the upper seven eighths of the spectrum:
// 1 % by chance.
TEST(RecencyTapers, PrewhiteningKeepsSlowMotionOutOfTheNoise) {
  RecencyTapers tapers(1024, 2, 3.0);
  Signal power(tapers.bins());
  double raw = 0.0;
  double whitened = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Signal x = testing::sum(testing::times(testing::tone(1024, 0.0013, 0.1 * seed), 1000.0),
                                  white_noise(1024, seed));
    tapers.spectrum(x, power);
    raw += mean_of(std::span(power).subspan(64)) / 20.0;
    tapers.prewhitened_spectrum(x, power);
    whitened += mean_of(std::span(power).subspan(64)) / 20.0;
  }
  EXPECT_GT(raw, 2.0) << "what leaks";
  EXPECT_NEAR(whitened, 1.0, 0.05);
}

// 1 / |1 - 0.98 e^-iw|^2, in bands of eight bins above those that the tapers blur: two degrees of freedom a bin, 200 windows.
TEST(RecencyTapers, PrewhitenedSpectrumIsThatOfTheProcess) {
  RecencyTapers tapers(1024, 2, 3.0);
  const std::array<double, 1> a = {0.98};
  Signal power(tapers.bins());
  Signal sum(tapers.bins());
  for (unsigned seed = 1; seed <= 200; ++seed) {
    tapers.prewhitened_spectrum(testing::autoregressive(a, 1024, seed), power);
    sum = testing::sum(sum, power, 1.0 / 200.0);
  }
  for (std::size_t begin = 8; begin + 8 < sum.size(); begin += 8) {
    double ratio = 0.0;
    for (std::size_t k = begin; k < begin + 8; ++k) {
      const double w = std::numbers::pi * static_cast<double>(k) / 512.0;
      ratio += sum[k] * (1.0 + 0.98 * 0.98 - 2.0 * 0.98 * std::cos(w)) / 8.0;
    }
    EXPECT_NEAR(ratio, 1.0, 0.12) << begin;
  }
}

// What does not change but for a slow drift: the division is bounded by what the tapers resolve.
TEST(RecencyTapers, PrewhiteningDoesNotBlowUpWhatIsSlowerThanTheTapers) {
  RecencyTapers tapers(1024, 2, 3.0);
  Signal ramp(1024);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<double>(i) / 1024.0 - 0.5;
  Signal plain(tapers.bins());
  Signal whitened(tapers.bins());
  tapers.spectrum(ramp, plain);
  tapers.prewhitened_spectrum(ramp, whitened);
  EXPECT_LT(whitened[0], 3.0 * plain[0]);
}

// The newest quarter holds 1 - phi(3/4) = 65 % of the way that a sine taper's energy is spread over.
TEST(RecencyTapers, LookAtTheNewestSamplesMost) {
  Signal newest(1024);
  Signal oldest(1024);
  std::fill(newest.begin() + 768, newest.end(), 1.0);
  std::fill(oldest.begin(), oldest.begin() + 256, 1.0);
  RecencyTapers tapers(1024, 2, 4.0);
  std::array<double, 1> new_energy{};
  std::array<double, 1> old_energy{};
  tapers.autocovariance(newest, new_energy);
  tapers.autocovariance(oldest, old_energy);
  EXPECT_GT(new_energy[0], 0.5);
  EXPECT_LT(old_energy[0], 0.01);
}

TEST(RecencyTapers, ShorterWindowsDoNotDependOnWhatCameBefore) {
  const Signal x = white_noise(300, 3);
  RecencyTapers used(1024, 2, 4.0);
  RecencyTapers fresh(1024, 2, 4.0);
  Signal a(used.bins());
  Signal b(used.bins());
  used.spectrum(white_noise(1024, 4), a);
  used.spectrum(x, a);
  fresh.spectrum(x, b);
  EXPECT_EQ(a, b);
}

TEST(RecencyTapers, AnotherRecencyIsAnotherObject) {
  const Signal x = white_noise(1024, 6);
  RecencyTapers changed(1024, 2, 3.0);
  RecencyTapers fresh(1024, 2, 0.75);
  Signal a(changed.bins());
  Signal b(changed.bins());
  changed.spectrum(x, a);
  changed.set_recency(0.75);
  changed.spectrum(x, a);
  fresh.spectrum(x, b);
  EXPECT_EQ(a, b);
}

TEST(RecencyTapers, AllocateNothingAfterConstruction) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const Signal x = white_noise(1024, 5);
  RecencyTapers tapers(1024, 2, 4.0);
  Signal power(tapers.bins());
  std::array<double, 4> r{};
  const auto before = testing::allocations();
  for (const std::size_t size : {64U, 1024U, 512U}) {
    tapers.spectrum(std::span(x).first(size), power);
    tapers.autocovariance(std::span(x).first(size), r);
  }
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace gyrod::core
